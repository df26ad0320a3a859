// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rviz/crowd/body_form.h"

namespace vegetation_sim::view {

/// Frames that vertices of a body follow.
enum class Bone : std::uint8_t {
  PELVIS,
  CHEST,
  HEAD,
  THIGH,
  SHANK = THIGH + 2,
  FOOT = SHANK + 2,
  UPPER_ARM = FOOT + 2,
  FOREARM = UPPER_ARM + 2,
  COUNT = FOREARM + 2
};
constexpr std::size_t BONES = static_cast<std::size_t>(Bone::COUNT);

using BoneAxes = Eigen::Matrix3d;

/// Axes and origin of a bone.
struct BoneFrame {
  BoneAxes axes{BoneAxes::Identity()};
  Vec3 origin{Vec3::Zero()};
};
using BoneFrames = std::array<BoneFrame, BONES>;
/// Returns the frames of a skeleton. @param left unit vector to the left of the walker.
BoneFrames framesOf(const crowd::Skeleton& skeleton, const Vec3& left);

/// Vertex of the skin in the pose of a BodyForm, in heights of the person.
struct SkinVertex {
  Vec3 position, normal;
  std::array<std::uint8_t, 2> bones{};  ///< as Bone
  double second{0.0};                   ///< weight of the second bone; the first has the rest
  double girth{0.0};                    ///< by how much a broad build is wider there, as a share
  double open{1.0};                     ///< share of the sky that the body itself leaves free
  double shade{1.0};                    ///< factor of the colour, from folds of clothes
  Cover cover{Cover::SKIN};
};
constexpr std::size_t MOST_SIDES = 12;
/// Ring of vertices. Consecutive rings are joined.
struct SkinRing {
  std::array<SkinVertex, MOST_SIDES> vertices;
  bool begins{false};  ///< is not joined to the ring before
  bool fine{false};    ///< is left out of small bodies
};
/// Returns the skin of a person; it is made once per process.
const std::vector<SkinRing>& bodyTemplate(bool long_hair);

}  // namespace vegetation_sim::view
