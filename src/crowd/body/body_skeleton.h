// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "crowd/body/gait.h"
#include "crowd/body/motion_style.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::crowd {

/// Parts of a body. Most exist twice: left, then right.
enum class Part : int {
  HEAD,
  NECK,
  CHEST,
  SHOULDERS,
  PELVIS,
  THIGH,
  SHANK = THIGH + 2,
  FOOT = SHANK + 2,
  UPPER_ARM = FOOT + 2,
  FOREARM = UPPER_ARM + 2,
  COUNT = FOREARM + 2
};
constexpr std::size_t PARTS = static_cast<std::size_t>(Part::COUNT);

/// A limb as a capsule in the world [m].
struct Limb {
  Vec3 from{Vec3::Zero()}, to{Vec3::Zero()};
  double radius{0.05};
};
using Skeleton = std::array<Limb, PARTS>;

/// Computes a walker's body: arms from the gait's joints; legs by two-bone inverse kinematics from
/// the pelvis, which is as high as both legs allow, to the planted feet. The index of a limb is
/// `Part` + side.
Skeleton skeletonOf(const Walker& walker, const terrain::HeightMap& terrain);
/// Computes the body of a walker with the style of its id; feet stand and swing where they do
/// without. @param seconds any time that rises, for the movement of people who stand.
Skeleton skeletonOf(const Walker& walker, const terrain::HeightMap& terrain,
                    const MotionStyles& styles, double seconds);

inline const Limb& limbOf(const Skeleton& skeleton, Part part, int side = 0) {
  return skeleton[static_cast<std::size_t>(part) + static_cast<std::size_t>(side)];
}

}  // namespace vegetation_sim::crowd
