// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>

namespace vegetation_sim {

/// Runs the body of a service, which returns its message; what it throws becomes success = false
/// and the message. @return true: false would look like a dead service.
template <class Response, class Body>
bool answer(Response& response, Body body) {
  try {
    response.message = body();
    response.success = true;
  } catch (const std::exception& error) {
    response = Response();
    response.success = false;
    response.message = error.what();
  }
  return true;
}

}  // namespace vegetation_sim
