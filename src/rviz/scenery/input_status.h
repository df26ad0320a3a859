// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::view {

/// How one input stands, for the display's status.
struct InputStatus {
  bool good{false};
  std::string text;
};

constexpr Nanoseconds SILENCE = 3 * NANOSECONDS_PER_SECOND;  ///< of a node that is missed

/// The status of an input whose newest message is of `stamp`, for a picture of `now`: a good one
/// that is more than 3 s old says so.
inline InputStatus unlessSilent(const InputStatus& status, Nanoseconds stamp, Nanoseconds now) {
  if (!status.good || now - stamp <= SILENCE) return status;
  return {false, "No message for 3 s: drawn as it was then"};
}

}  // namespace vegetation_sim::view
