// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "rviz/textures/sky_texture.h"
#include "rviz/trees/tree_set.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::view {

/// Seed of the noise of the ground: meadows and the land around them agree.
constexpr std::uint64_t GROUND_SEED = 0x6a55;

/// Square of ground with a texture of its own, layout's frame [m].
struct Plot {
  double x{0.0}, y{0.0};  ///< south-west corner
  double edge{64.0};
};
/// Returns a square around the trees with a margin for their shadows.
Plot plotAround(const Extent& extent);

/// Part of the pixels of a plot, counted from the south-west.
struct Window {
  int column{0}, row{0}, columns{0}, rows{0};
};
/// Returns the whole plot with so many pixels along its edge.
inline Window wholePlot(int edge) {
  return {0, 0, edge, edge};
}
/// Returns the pixels of the plot in an extent, and some around it so that five mipmaps have whole
/// pixels too.
Window windowAround(const Plot& plot, int edge, const Extent& extent);

/// Returns the unlit colour of grass and forest floor.
/// @param shelter 0 in the open, 1 under a closed canopy.
Rgba groundColour(const Noise& noise, double x, double y, double shelter, const Rgba& tint);

/// Returns the light on open ground with this normal.
Rgba openLight(const Daylight& daylight, const Vec3& normal);

/// Shares of light that reach the ground of a plot.
struct Shade {
  std::vector<float> sun;                  ///< of sunlight, as castShadows(); empty means 1
  std::function<double(const Vec3&)> sky;  ///< share of skylight at a place; empty means 1
};

/// Paints a window of the lit plot from above, north at the top. @param shade of the window.
Image groundPicture(const Plot& plot, int edge, const Window& window, const Shade& shade,
                    const terrain::HeightMap& terrain, const Daylight& daylight, const Rgba& tint);
/// Paints the whole plot.
Image groundPicture(const Plot& plot, int edge, const TreeSet& tree_set,
                    const terrain::HeightMap& terrain, const Daylight& daylight, const Rgba& tint);

}  // namespace vegetation_sim::view
