// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::forest {

enum class Shape : int { SPHERE = 0, CAPSULE = 1, BOX = 2 };

/// A robot body that pushes plants.
struct Body {
  std::string id;     ///< names the body in reactions
  std::string frame;  ///< tf frame to which it is attached
  Shape shape{Shape::SPHERE};
  /// Sphere: radius, -, -. Capsule along its z axis: radius, -, distance of the cap centres. Box:
  /// edges. [m]
  Vec3 size{Vec3(0.05, 0.0, 0.0)};
  Pose pose;                    ///< world, at `stamp`
  Vec3 velocity{Vec3::Zero()};  ///< of the pose's origin, world [m/s]
  Vec3 spin{Vec3::Zero()};      ///< world [rad/s]
  Nanoseconds stamp{0};
  Pose in_frame;  ///< of the body in its frame
};

using Bodies = std::map<std::string, Body>;  ///< by id

}  // namespace vegetation_sim::forest
