// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "grass/mesh/grass_geometry.h"
#include "rviz/ground/ground_texture.h"

namespace vegetation_sim::view {

/// Converts daylight to the light of grass.
grass::GrassLight grassLight(const Daylight& daylight);

/// Density from which grass covers the ground [blades/m^2].
double fullDensity(const grass::FeatureMap& map);
/// Returns whether nothing grows there.
bool isBare(const grass::FeatureMap& map);
/// Returns whether a texture has a pixel for each tile: for at most 2048 tiles a side.
bool isPaintable(const grass::FeatureMap& map);

/// Paints a meadow from above: soil and grass with the colour and density of the map, lodged where
/// it is trodden. It uses no Ogre.
class MeadowPainter {
 public:
  /// All arguments must outlive it.
  MeadowPainter(const grass::FeatureMap& map, const terrain::HeightMap& terrain,
                const Daylight& daylight, const Rgba& tint);

  /// Returns the square that contains the map and shares its south-west corner.
  const Plot& plot() const { return plot_; }
  int edge() const { return edge_; }               ///< of the whole texture [pixel]
  int pixelsPerTile() const { return per_tile_; }  ///< a power of two

  Image whole() const;
  /// Paints one tile. A null `patch` is untrodden.
  Image tile(int column, int row, const grass::CrushPatch* patch) const;
  /// Sets the discs that colour what is painted from now on.
  void setColours(std::vector<grass::ColourMask> masks) { masks_ = std::move(masks); }
  /// Returns the place of a tile in the texture.
  int left(int column) const { return column * per_tile_; }
  int top(int row) const { return edge_ - (row + 1) * per_tile_; }

 private:
  /// State of the grass at a place.
  struct Ground {
    double crush{0.0};         ///< 0 upright to 1 flat
    Vec3 lying{Vec3::Zero()};  ///< direction of lodged grass times crush
    double cut{0.0};           ///< removed share of the height
    double swath{0.0};         ///< cut grass that lies there [kg/m^2]
  };
  Ground groundAt(const grass::CrushPatch& patch, double x, double y, double u, double v) const;
  Rgba colourAt(double x, double y, const Ground& ground) const;

  const grass::FeatureMap& map_;
  const terrain::HeightMap& terrain_;
  const Daylight& daylight_;
  Rgba tint_;
  grass::GrassLight light_;
  double full_;  ///< density that covers the ground
  Plot plot_;
  int per_tile_, edge_;
  Noise noise_;
  std::vector<grass::ColourMask> masks_;
};

/// Paints the texture of strips and its mipmaps, which keep the coverage at each height for each
/// alpha test, so that far grass does not thin out.
std::vector<Image> stripPictures(int columns, int rows, int blades);
/// Paints blades from above for layers: repeating dots, each with an alpha of its own.
/// @param edge must be a power of two.
std::vector<Image> layerPictures(int edge);

}  // namespace vegetation_sim::view
