// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scenes {

/// The hashes of a scene, each chained over all ticks that are looked at.
struct Hashes {
  Hash state;      ///< of all that the coming ticks depend on
  Hash reference;  ///< of poses and reactions in double precision
  Hash display;    ///< of what displays and sensors rebuild, in single precision where they do
};

inline void addPose(const Pose& pose, Hash& hash) {
  hash.add(pose.position);
  for (const double value :
       {pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z})
    hash.add(value);
}

/// Adds the first `count` values. A float becomes the double of the same value, which keeps apart
/// what differs to the bit.
inline void addFloats(const float* values, std::size_t count, Hash& hash) {
  for (std::size_t i = 0; i < count; ++i) hash.add(double{values[i]});
}
inline void addFloats(const std::vector<float>& values, Hash& hash) {
  addFloats(values.data(), values.size(), hash);
}

}  // namespace vegetation_sim::scenes
