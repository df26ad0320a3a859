// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::view {

/// State of one input, for the status of a display.
struct InputStatus {
  bool good{false};
  std::string text;
};

constexpr Nanoseconds SILENCE = 3 * NANOSECONDS_PER_SECOND;  ///< after which a warning is shown

/// Returns the status of an input at the time `now` of the picture. A message whose stamp is more
/// than 3 s old is reported with its age.
inline InputStatus unlessSilent(const InputStatus& status, Nanoseconds stamp, Nanoseconds now) {
  if (!status.good || now - stamp <= SILENCE) return status;
  return {false, "No message for 3 s: drawn as it was then"};
}

}  // namespace vegetation_sim::view
