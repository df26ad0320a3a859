// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"
#include "vegetation_sim/terrain/grey_image.h"

namespace vegetation_sim::terrain {

/// The keys of a terrain's YAML file besides `image`, the path of its picture relative to that
/// file.
struct HeightMapLaw {
  double resolution{1.0};     ///< Distance between neighbouring samples [m].
  Vec3 origin{Vec3::Zero()};  ///< World position of the lower left sample, at height 0 [m].
  double height_min{0.0};     ///< Height of black above the origin [m].
  double height_max{1.0};     ///< Height of white above the origin [m].
};

void describe(FieldVisitor& visitor, HeightMapLaw& law);

/// Box around a terrain in the world [m].
struct Bounds {
  double min_x, max_x, min_y, max_y, min_z, max_z;
};

/// Ground height as a function of the place: a grid of heights with bilinear interpolation,
/// continued at constant height beyond the border. Samples stand on the grid's corners: an image of
/// 257 columns at 1 m covers 256 m. The picture's top row is north (largest y), as in map_server.
/// Immutable: share it by pointer, read it from any thread. The same bits on every processor.
class HeightMap {
 public:
  /// Flat ground at z = 0.
  HeightMap() = default;
  /// @throws InvalidInput with all faults of the law and the image.
  HeightMap(const HeightMapLaw& law, GreyImage image);

  /// Reads a YAML file and its picture; an empty name gives flat ground. @throws InvalidInput
  /// naming
  /// file, key, value and allowed range, with all faults of the YAML at once.
  static HeightMap load(const std::string& file);

  bool isFlat() const { return image_.samples.empty(); }
  /// Returns the height of the ground at (x, y) [m]. A coordinate that is not a number counts as
  /// the border.
  double height(double x, double y) const;
  /// Returns the upward unit normal of the facet at (x, y), which is vertical beyond the border.
  Vec3 normal(double x, double y) const;
  /// Returns the box around the samples, infinite in x and y if the ground is flat.
  Bounds bounds() const { return bounds_; }
  /// Returns the distance between samples [m], or 0 if the ground is flat.
  double resolution() const { return isFlat() ? 0.0 : law_.resolution; }
  /// Returns an upper bound of the slope of the ground in any direction.
  double steepest() const { return steepest_; }
  /// Part of the ground, which is nowhere above `top`. A block at the border goes on beyond it.
  struct Block {
    double min_x, max_x, min_y, max_y, top;  ///< world [m]
  };
  /// Returns the block that (x, y) is in; the ground must not be flat.
  Block blockAt(double x, double y) const;
  /// Returns a hash of all samples and of the law.
  std::uint64_t hash() const { return hash_; }

 private:
  struct Cell;
  Cell cellAt(double x, double y) const;
  double sample(int column, int row_from_south) const;
  double findSteepest() const;
  void findTops();

  static constexpr int BLOCK = 16;  ///< intervals between samples along a block
  static constexpr double ENDLESS = std::numeric_limits<double>::infinity();

  HeightMapLaw law_{};
  GreyImage image_{};
  double base_{0.0};   ///< Height of black in the world [m].
  double scale_{0.0};  ///< Height of one grey level [m].
  double steepest_{0.0};
  int block_columns_{0}, block_rows_{0};
  std::vector<double> tops_;  ///< [block_rows_ x block_columns_] highest sample of each block [m]
  Bounds bounds_{-ENDLESS, ENDLESS, -ENDLESS, ENDLESS, 0.0, 0.0};
  std::uint64_t hash_{0};
};

}  // namespace vegetation_sim::terrain
