// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::forest {

/// A camera that determines levels of detail.
struct Viewer {
  std::string id;
  Viewpoint eye;
  Nanoseconds stamp{0};  ///< of its last message
};
/// A viewer without a message for this long is removed.
constexpr Nanoseconds VIEWER_LIFE = 3 * NANOSECONDS_PER_SECOND;

}  // namespace vegetation_sim::forest
