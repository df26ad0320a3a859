// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "crowd/body/body_skeleton.h"
#include "crowd/body/clothes.h"

namespace vegetation_sim::view {

/// Ellipse around a part of a body. Consecutive rings are joined to a tube.
struct BodyRing {
  Vec3 centre{Vec3::Zero()};  ///< world [m]
  /// Unit vectors along the tube, to the left and to the back of the body.
  Vec3 along{Vec3::UnitZ()}, across{Vec3::UnitY()}, back{-Vec3::UnitX()};
  double broad{0.0}, deep{0.0};                     ///< half axes across and to the back [m]
  Vec3 colour{Vec3::Zero()}, behind{Vec3::Zero()};  ///< of the front and the back
  double nose{0.0};                                 ///< length of a nose in front [m]
  bool eyes{false};                                 ///< dark to both sides of the nose
  bool begins{false};                               ///< begins another tube
  bool fine{false};                                 ///< is left out of small bodies
};

/// Replaces `out` by the rings of a body: trunk and neck, head, arms with hands, legs, shoes.
/// @param left unit vector to the left of the walker.
void shapeBody(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes, const Vec3& left,
               std::vector<BodyRing>& out);

}  // namespace vegetation_sim::view
