// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "crowd/body/body_skeleton.h"
#include "crowd/body/clothes.h"
#include "grass/mesh/grass_geometry.h"
#include "rviz/textures/sky_texture.h"
#include "rviz/trees/shared_light.h"

namespace vegetation_sim::view {

/// Level of detail of a body, and its heading.
struct BodyStyle {
  int sides{12};      ///< of a tube: 12, 6 or 3
  double odd{1.0};    ///< 0: odd edges lie between their neighbours, as with half the sides
  double rings{1.0};  ///< 0: fine rings lie between their neighbours, and are left out
  double left_x{0.0}, left_y{1.0};  ///< unit vector to the left of the walker
};
/// Returns the style of a body of this height in the picture. It is continuous in the height.
BodyStyle bodyStyle(double pixels);

/// Returns the shares of light that reach a place.
using LightAt = std::function<SharedLight::Shares(const Vec3& place)>;

/// Appends a lit body.
void appendBody(const crowd::Skeleton& skeleton, const crowd::Clothes& clothes,
                const BodyStyle& style, const Daylight& daylight, const LightAt& light,
                grass::GrassMesh& mesh);

}  // namespace vegetation_sim::view
