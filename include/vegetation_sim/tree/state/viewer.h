// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::forest {

/// A camera that determines the levels of detail of displays.
struct Viewer {
  std::string id;
  Viewpoint eye;
  Nanoseconds stamp{0};  ///< of its last message
};

/// A sensor that determines the levels of detail of what sensors perceive: in its range, the error
/// of trees may not exceed its tolerance.
struct Sensor {
  std::string id;
  Vec3 position{Vec3::Zero()};
  double range{0.0};       ///< [m]
  double tolerance{0.05};  ///< [m]
  Nanoseconds stamp{0};    ///< of its last message
};

/// A sensor without a message for this long is removed.
constexpr Nanoseconds SENSOR_LIFE = 3 * NANOSECONDS_PER_SECOND;

}  // namespace vegetation_sim::forest
