// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "reference/grass/blade_plain.h"
#include "vegetation_sim/grass/blades/blade_batch.h"

namespace vegetation_sim::grass {

/// Makes a tile of a flat meadow whose corners have these densities [blades/m^2].
inline Tile tileOf(const Corners& density, int column = 0, int row = 0, std::uint64_t seed = 5) {
  Tile tile = makeTile(FeatureMap(), terrain::HeightMap(), seed, column, row);
  tile.density = density;
  tile.blades = bladeCount(density, tile.size, 0.0);
  return tile;
}

/// Makes ground that rises along x by `slope_x` and along y by `slope_y`, slightly uneven.
inline terrain::HeightMap slopedGround(double slope_x, double slope_y) {
  terrain::HeightMapLaw law;
  law.resolution = 1.0;
  law.height_max = 40.0;
  terrain::GreyImage image{33, 33, 65535, {}};
  for (int row = 32; row >= 0; --row)
    for (int column = 0; column < 33; ++column) {
      const double z = 5.0 + slope_x * column + slope_y * row + 0.1 * ((column * row) % 3);
      image.samples.push_back(static_cast<std::uint16_t>(z / 40.0 * 65535.0));
    }
  return terrain::HeightMap(law, image);
}

/// Returns the probability that chi-square with `degrees` degrees of freedom is above `x` (Wilson
/// and Hilferty 1931; good to a few percent of itself from 30 degrees on, enough for bounds of
/// 1e-4).
inline double chiSquareTail(double x, double degrees) {
  const double t = 2.0 / (9.0 * degrees);
  const double z = (std::cbrt(x / degrees) - (1.0 - t)) / std::sqrt(t);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// Returns the length of the polyline of a blade.
template <class At>
double polylineLength(At&& at) {
  double sum = 0.0;
  for (int i = 0; i < LINKS; ++i) sum += (at(i + 1) - at(i)).norm();
  return sum;
}

inline Vec3 pointOf(const std::vector<BladeBlock>& blocks, int blade, int point) {
  const BladeBlock& b = blocks[static_cast<std::size_t>(blade / BLOCK)];
  const int lane = blade % BLOCK;
  return {b.x[point][lane], b.y[point][lane], b.z[point][lane]};
}

inline std::vector<BladeBlock> posed(const Tile& tile, const TileMotion& motion, int count,
                                     Store store = Store::CACHED) {
  std::vector<BladeBlock> out(static_cast<std::size_t>(blocksFor(count)));
  poseBlades(tile, motion, count, out.data(), store);
  return out;
}

inline std::vector<BladeBlock> posedPlain(const Tile& tile, const TileMotion& motion, int count) {
  std::vector<BladeBlock> out(static_cast<std::size_t>(blocksFor(count)));
  poseBladesPlain(tile, motion, count, out.data());
  return out;
}

/// Makes a patch whose tilt rises from 0 in the west to `tilt` [rad] in the east, pressed along (x,
/// y).
inline CrushPatch rampPatch(float tilt, float x, float y, int cells = 10) {
  CrushPatch patch;
  patch.cells = cells;
  for (int row = 0; row <= cells; ++row)
    for (int column = 0; column <= cells; ++column) {
      const float t = tilt * static_cast<float>(column) / static_cast<float>(cells);
      patch.tilt.push_back(t);
      patch.tx.push_back(t * x);
      patch.ty.push_back(t * y);
    }
  return patch;
}

}  // namespace vegetation_sim::grass
