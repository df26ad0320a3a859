// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

/// Returns the text with which a call rejects its input, or an empty text if it does not.
template <class Call>
std::string errorOf(Call&& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

}  // namespace vegetation_sim
