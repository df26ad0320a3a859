// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <vegetation_sim/ErrorCode.h>

#include <exception>
#include <stdexcept>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

template <class Response>
void setErrorCode(Response& response, FaultCode code) {
  static_assert(static_cast<std::uint8_t>(FaultCode::INTERNAL) == ErrorCode::INTERNAL);
  response.error_code = static_cast<std::uint8_t>(code);
}
// Those of std_srvs have no such field.
inline void setErrorCode(std_srvs::Trigger::Response&, FaultCode) {}
inline void setErrorCode(std_srvs::SetBool::Response&, FaultCode) {}

/// Returns the code of an exception; std::out_of_range is a number that is unknown.
inline FaultCode codeOf(const std::exception& error) {
  if (const auto* input = dynamic_cast<const InvalidInput*>(&error)) return input->code();
  if (dynamic_cast<const std::out_of_range*>(&error) != nullptr) return FaultCode::UNKNOWN;
  return FaultCode::INTERNAL;
}

/// Runs the body of a service, which returns its message; what it throws becomes success = false
/// and the message. @return true: false would look like a dead service.
template <class Response, class Body>
bool answer(Response& response, Body body) {
  try {
    response.message = body();
    response.success = true;
  } catch (const std::exception& error) {
    response = Response();
    setErrorCode(response, codeOf(error));
    response.success = false;
    response.message = shortened(error.what(), LONGEST_ERROR);
  }
  return true;
}

}  // namespace vegetation_sim
