// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "rviz/textures/sky_texture.h"
#include "rviz/trees/tree_set.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::view {

/// Square of ground that gets a picture of its own, layout's frame [m].
struct Plot {
  double x{0.0}, y{0.0};  ///< south-west corner
  double edge{64.0};
};
/// Square around the trees with room for their shadows.
Plot plotAround(const Extent& extent);

/// Grass and forest floor: colour of the ground without light.
/// @param shelter 0: open, 1: under a closed canopy.
Rgba groundColour(const Noise& noise, double x, double y, double shelter, const Rgba& tint);

/// Light on open ground with this normal.
Rgba openLight(const Daylight& daylight, const Vec3& normal);

/// Part of the sun that leaves let through to each pixel of the plot: the trees' shadows, sharper
/// than the grid of light. [edge x edge], south first.
std::vector<float> shadowsOn(const Plot& plot, int edge, const TreeSet& tree_set,
                             const terrain::HeightMap& terrain, const Vec3& to_sun);

/// What keeps light from the ground of a plot.
struct Shade {
  std::vector<float> sun;  ///< part of the sun that arrives, as shadowsOn(); empty: all of it
  std::function<double(const Vec3&)> sky;  ///< part of the sky's light at a place; empty: all of it
};

/// Throws what is told to it, balls that stand in the sun, on the plot. As shadowsOn().
using ShadowDrop = std::function<void(const Vec3& at, double radius, double depth)>;
std::vector<float> castShadows(const Plot& plot, int edge, const terrain::HeightMap& terrain,
                               const Vec3& to_sun,
                               const std::function<void(const ShadowDrop&)>& report);

/// The plot from above, north on top, with its light.
Image groundPicture(const Plot& plot, int edge, const Shade& shade,
                    const terrain::HeightMap& terrain, const Daylight& daylight, const Rgba& tint);
Image groundPicture(const Plot& plot, int edge, const TreeSet& tree_set,
                    const terrain::HeightMap& terrain, const Daylight& daylight, const Rgba& tint);

/// Fine grain that repeats, mean one half. @param edge a power of two.
Image grainPicture(int edge);

}  // namespace vegetation_sim::view
