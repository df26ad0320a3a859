// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grass/lod/node_wind.h"
#include "grass/lod/tile_level.h"
#include "grass/mesh/grass_light.h"
#include "grass/mesh/mesh_list.h"

namespace vegetation_sim::grass {

/// Triangles of many tiles in one list.
struct GrassMesh {
  MeshList<float> positions;        ///< [vertices x 3] world, from the mesh's origin [m]
  MeshList<float> texture;          ///< [vertices x 2]
  MeshList<std::uint8_t> colours;   ///< [vertices x 4] red, green, blue, alpha
  MeshList<std::uint32_t> indices;  ///< [triangles x 3]
  Vec3 origin{Vec3::Zero()};        ///< origin of the positions, world [m]

  std::size_t vertexCount() const { return positions.size() / 3; }
  void clear();
};

/// How the blades of a tile are drawn.
struct RibbonStyle {
  int segments{LINKS};               ///< segments of each blade: 1, 2, 3 or LINKS
  double width{1.0};                 ///< factor, 1 / bladeShare
  double slide{0.0};                 ///< Morph::slide
  double leaving{0.0};               ///< share of the last blades that narrow to nothing
  Vec3 eye{Vec3(0.0, 0.0, 1e3)};     ///< position of the viewer, world [m]; ribbons face it
  const GrassLight* light{nullptr};  ///< null: colours of the map, dark at the root
  /// Blades on cut ground have no flowers and the pale colour of their stems; null: none is cut.
  const CrushPatch* crush{nullptr};
  /// Variation between blades in colour, length and lean; 1 is that of a meadow. Varied blades have
  /// seed heads, and their flowers stand in drifts.
  float variety{0.f};
  /// 0: the blades themselves; above: varied copies that lean away from them.
  int sibling{0};
  double spread{0.0};  ///< largest distance of the roots of siblings along x or y [m]
};

/// Appends blades of poseBlades() as tapering ribbons (paper 2, section 3.3). A blade of n segments
/// takes 2 n + 1 vertices and 2 n - 1 triangles; the flower or seed head at its tip takes 7 and 6.
void appendRibbons(const FeatureMap& map, const Tile& tile, const BladeBlock* blocks, int count,
                   const RibbonStyle& style, GrassMesh& mesh);

/// Appends the four vertical strips on the edges of a tile (S2-10), whose tops are displaced by
/// wind and tread (S2-19) and which are `grown` times as high as the grass. Texture: x along the
/// edge in widths of the picture, y up. Alpha is the density as a share of `full_density`: a texel
/// is drawn if its own alpha is above 1 - alpha.
void appendStrips(const FeatureMap& map, const Tile& tile, const TileMotion& motion, double grown,
                  double full_density, GrassMesh& mesh, const GrassLight* light = nullptr);

/// Appends strips inside of a tile, `rows` along x and as many along y. They are curved so that a
/// meadow shows no grid. Otherwise the same as appendStrips().
void appendRows(const FeatureMap& map, const Tile& tile, const TileMotion& motion, int rows,
                double grown, double full_density, GrassMesh& mesh,
                const GrassLight* light = nullptr);

/// Appends `layers` squares parallel to the ground (S2-W3). Higher layers are displaced more and
/// have less alpha, which otherwise is that of strips.
void appendLayers(const FeatureMap& map, const Tile& tile, const TileMotion& motion, int layers,
                  double grown, double full_density, GrassMesh& mesh,
                  const GrassLight* light = nullptr);

constexpr int STRIP_CELLS = 4;         ///< cells of a strip along an edge
constexpr double PICTURE_WIDTH = 1.0;  ///< width of the strips' picture [m]

/// Image of the strips. Each of its `blades` blades has an alpha of its own, so that an alpha test
/// shows as many as wanted (S2-10). The top row is first.
struct StripPicture {
  int columns{0}, rows{0};
  /// [rows x columns x 4] red, green, blue (all light) and alpha
  std::vector<std::uint8_t> pixels;
};
StripPicture makeStripPicture(int columns, int rows, int blades, std::uint64_t seed);

/// Returns the colours of the ground, one texel a node, south row first: soil where grass is thin,
/// the mean of the species where it is dense (S2-13). [rows x columns x 3]
std::vector<std::uint8_t> groundColours(const FeatureMap& map, double full_density);

/// Returns the colour of a species between fresh and dry, each component 0 to 1.
Vec3 bladeColour(const Species& species, double colour);
/// Returns the colour of the mix of species at a place.
Vec3 meanColour(const FeatureMap& map, const Features& features);
/// Returns the colour of grass of which no blade can be distinguished: blades and flowers count by
/// their areas, so that a meadow keeps the colour of its flowers far away (S2-18).
Vec3 farColour(const FeatureMap& map, const Features& features);

}  // namespace vegetation_sim::grass
