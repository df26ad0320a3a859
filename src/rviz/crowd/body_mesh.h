// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/walker/body_skeleton.h"
#include "crowd/walker/clothes.h"
#include "grass/mesh/grass_geometry.h"
#include "rviz/textures/sky_texture.h"

namespace vegetation_sim::view {

/// How finely a body is drawn.
struct BodyStyle {
  int sides{12};     ///< of a limb: 12, 6 or 3
  double odd{1.0};   ///< 0: every other side's edge is halfway between the others, as with half
  double caps{1.0};  ///< how round limbs end; 0: not at all, but for the head
  double left_x{0.0},
      left_y{1.0};  ///< unit, to the left of the walker: bodies are broader that way
};
/// Of a body that is so many pixels high. What changes with it changes without a step.
BodyStyle bodyStyle(double pixels);

/// Appends a lit body: limbs that taper, a flat chest, hair and hands. No Ogre in it.
void appendBody(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes,
                const BodyStyle& style, const Daylight& daylight, grass::GrassMesh& mesh);

}  // namespace vegetation_sim::view
