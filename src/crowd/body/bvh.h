// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::crowd {

/// Motion data of a BVH file (Biovision Hierarchy).
struct BvhMotion {
  /// Positions are 0 to 2, rotations 3 to 5: x, y, z.
  static constexpr int FIRST_ROTATION = 3;
  struct Joint {
    std::string name;           ///< "End Site" for the end of a limb
    int parent{-1};             ///< index; -1 for the root
    Vec3 offset{Vec3::Zero()};  ///< from the parent, in the unit of the file
    std::vector<int> channels;  ///< in the order of the file
  };
  std::vector<Joint> joints;   ///< parents before their children
  double frame_time{0.0};      ///< [s]
  std::size_t channels{0};     ///< of all joints
  std::vector<double> values;  ///< `channels` numbers of each frame; angles in degrees

  std::size_t frames() const { return channels > 0 ? values.size() / channels : 0; }
};

/// Largest file [B].
constexpr std::size_t LARGEST_BVH = 32U << 20;

/// Reads the text of a BVH file: one hierarchy with channels in any order, and at least two frames.
/// @param name of the file, for errors. @throws InvalidInput with the line, the value and the
/// allowed range.
BvhMotion parseBvh(const std::string& text, const std::string& name);

/// Returns the positions of all joints in a frame, in the unit and the axes of the file.
std::vector<Vec3> jointPositions(const BvhMotion& motion, std::size_t frame);

}  // namespace vegetation_sim::crowd
