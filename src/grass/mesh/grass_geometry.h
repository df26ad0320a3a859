// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grass/lod/node_wind.h"
#include "grass/lod/tile_level.h"
#include "grass/mesh/grass_light.h"

namespace vegetation_sim::grass {

/// Triangles for drawing, in one list so that many tiles are one batch.
struct GrassMesh {
  std::vector<float> positions;        ///< [vertices x 3] world, from the mesh's origin [m]
  std::vector<float> texture;          ///< [vertices x 2]
  std::vector<std::uint8_t> colours;   ///< [vertices x 4] red, green, blue, alpha
  std::vector<std::uint32_t> indices;  ///< [triangles x 3]
  Vec3 origin{Vec3::Zero()};           ///< [m], world

  std::size_t vertexCount() const { return positions.size() / 3; }
  void clear();
};

/// What drawing needs of a tile's blades.
struct RibbonStyle {
  int segments{LINKS};               ///< of each blade: 1, 2, 3 or LINKS
  double width{1.0};                 ///< factor, 1 / bladeShare
  double slide{0.0};                 ///< Morph::slide
  double leaving{0.0};               ///< share of the blades, the last ones, that narrow to nothing
  Vec3 eye{Vec3(0.0, 0.0, 1e3)};     ///< ribbons turn their faces to it, world [m]
  const GrassLight* light{nullptr};  ///< none: colours as the map has them, dark at the root
  float variety{0.f};  ///< of colour and lightness from blade to blade, 1: as in a meadow
};

/// Appends blades that poseBlades made as tapering ribbons (paper 2, section 3.3): 2 n + 1 vertices
/// and 2 n - 1 triangles a blade of n segments, and 7 and 6 for the flower at its tip, if any.
void appendRibbons(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks, int count,
                   const RibbonStyle& style, GrassMesh& mesh);

/// Appends the four vertical strips on the edges of a tile (S2-10), their tops displaced by wind
/// and tread (S2-19), each `grown` times the height of the grass high. Texture: x along the edge in
/// widths of the picture, y up; alpha is the density as a share of `full_density`: draw a texel if
/// its own alpha is above 1 - that.
void appendStrips(const FeatureMap& map, const Tile& tile, const TileMotion& motion, double grown,
                  double full_density, GrassMesh& mesh, const GrassLight* light = nullptr);

/// Appends strips inside of a tile, `rows` along x and as many along y, which wind so that a meadow
/// of many tiles shows no grid; else as appendStrips().
void appendRows(const FeatureMap& map, const Tile& tile, const TileMotion& motion, int rows,
                double grown, double full_density, GrassMesh& mesh,
                const GrassLight* light = nullptr);

/// Appends `layers` squares parallel to the ground, the higher the more displaced (S2-W3), alpha as
/// for strips, less with height.
void appendLayers(const FeatureMap& map, const Tile& tile, const TileMotion& motion, int layers,
                  double grown, double full_density, GrassMesh& mesh,
                  const GrassLight* light = nullptr);

constexpr int STRIP_CELLS = 4;         ///< along an edge
constexpr double PICTURE_WIDTH = 1.0;  ///< of the strips' picture [m]

/// Image of the strips: `blades` blades, each with an alpha of its own, so that a test against
/// alpha shows as many as wanted (S2-10). Top row first.
struct StripPicture {
  int columns{0}, rows{0};
  std::vector<std::uint8_t> pixels;  ///< [rows x columns x 4] red, green, blue (all light), alpha
};
StripPicture makeStripPicture(int columns, int rows, int blades, std::uint64_t seed);

/// Colours of the ground, one texel a node, south row first: soil where grass is thin, the mean of
/// the species where it is dense (S2-13). [rows x columns x 3]
std::vector<std::uint8_t> groundColours(const FeatureMap& map, double full_density);

/// Colour of grass of a species between fresh and dry, each component 0 to 1.
Vec3 bladeColour(const Species& species, double colour);
/// Colour of the mix of species at a place.
Vec3 meanColour(const FeatureMap& map, const Features& features);

}  // namespace vegetation_sim::grass
