// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "grass/mesh/grass_geometry.h"
#include "rviz/ground/ground_texture.h"

namespace vegetation_sim::view {

/// Daylight in the terms of grass.
grass::GrassLight grassLight(const Daylight& daylight);

/// Density [blades/m^2] from which a picture of grass is closed.
double fullDensity(const grass::FeatureMap& map);
/// Nothing grows there.
bool isBare(const grass::FeatureMap& map);
/// Whether a picture has a pixel for each tile: of maps with at most 2048 tiles a side.
bool isPaintable(const grass::FeatureMap& map);

/// Paints a meadow from above: soil and grass with the colour and density of the map, lodged where
/// it is trodden (S2-13). No Ogre in it.
class MeadowPainter {
 public:
  /// All must outlive it.
  MeadowPainter(const grass::FeatureMap& map, const terrain::HeightMap& terrain,
                const Daylight& daylight, const Rgba& tint);

  /// Square that holds the map, its south-west corner that of the map.
  const Plot& plot() const { return plot_; }
  int edge() const { return edge_; }               ///< of the whole picture [pixel]
  int pixelsPerTile() const { return per_tile_; }  ///< a power of two

  Image whole() const;
  /// One tile. `patch` may be null: untrodden.
  Image tile(int column, int row, const grass::CrushPatch* patch) const;
  /// Where a tile's picture lies in the whole one.
  int left(int column) const { return column * per_tile_; }
  int top(int row) const { return edge_ - (row + 1) * per_tile_; }

 private:
  Rgba colourAt(double x, double y, double crush, const Vec3& lying) const;

  const grass::FeatureMap& map_;
  const terrain::HeightMap& terrain_;
  const Daylight& daylight_;
  Rgba tint_;
  grass::GrassLight light_;
  double full_;  ///< density
  Plot plot_;
  int per_tile_, edge_;
  Noise noise_;
};

/// The strips' picture and its smaller versions, which show the same share of blades at each height
/// for each test against alpha, so that far grass does not thin out.
std::vector<Image> stripPictures(int columns, int rows, int blades);
/// Blades from above, for layers (S2-W3): dots with an alpha of their own, repeating. @param edge a
/// power of two.
std::vector<Image> layerPictures(int edge);

}  // namespace vegetation_sim::view
