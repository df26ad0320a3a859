// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "sensors/grass/grass_volume.h"
#include "sensors/media/beer_lambert.h"
#include "sensors/media/cell_walk.h"

namespace vegetation_sim::scan {
namespace {

constexpr double BLADE_RISE = 0.05;    // height of the steps along a column [m]
constexpr double STEEP = 0.9;          // vertical component from which a ray stays in a column
constexpr double BLADE_STRETCH = 0.4;  // part of a ray with one bound [m]
constexpr std::uint32_t BLADE_SEED = 0x626c6164U;

}  // namespace

// Returns an upper bound of the extinction along a part of a ray, or -1 if that part is above the
// layer. The grass is that of the middles of cells, up to half a cell away.
double GrassVolume::boundWithin(const Ray& ray, double from, double to) const {
  const Vec3 a = ray.at(from), b = ray.at(to);
  const double lowest = std::min(above(a), above(b)) - 0.5 * terrain_->steepest() * (to - from);
  if (lowest > tallest_) return -1.0;
  const Vec3 margin(0.5 * GRASS_CELL, 0.5 * GRASS_CELL, 0.0);
  const Vec3 low = a.cwiseMin(b) - margin, size = a.cwiseMax(b) + margin - low;
  const int columns = 1 + static_cast<int>(size.x() / bounds_.edge());
  const int rows = 1 + static_cast<int>(size.y() / bounds_.edge());
  double out = 0.0;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      out = std::max(out, bounds_.at(low.x() + size.x() * column / columns,
                                     low.y() + size.y() * row / rows, lowest));
  return out;
}

// Steps without grass are left out. Returns the distance at which the ray leaves the layer, hits a
// blade or has come as far as there are columns.
double GrassVolume::marchBlades(const Ray& ray, double from, const BladeColumns& form,
                                Hit& nearest) const {
  ColumnWalk columns(ray, form.width, BLADE_RISE,
                     static_cast<std::uint32_t>(layout_.seed) ^ BLADE_SEED);
  while (from < std::min(nearest.distance, form.reach)) {
    const double to = std::min(from + BLADE_STRETCH, nearest.distance);
    const double bound = boundWithin(ray, from, to + 2.0 * form.width);
    if (bound < 0.0) return from;
    if (bound > 0.0) {
      columns.enter(from);
      from = meetColumns(columns, to, bound, nearest);
    } else {
      columns.leave();
      from = to;
    }
  }
  return from;
}

// A column stops a ray at the optical depth of its random number, summed over the steps within it.
// Extinction falls with the height, so that a column ends like a blade.
double GrassVolume::meetColumns(ColumnWalk& columns, double to, double bound, Hit& nearest) const {
  const Ray& ray = columns.ray();
  const bool steep = std::fabs(ray.direction.z()) > STEEP;
  for (; columns.at() < std::min(to, nearest.distance);) {
    const ColumnWalk::Step step = columns.next(nearest.distance);
    const double share = columns.share();
    if (!steep && !mayBeBelow(columns.spent() + bound * step.length(), share)) continue;
    const Vec3 middle = ray.at(0.5 * (step.from + step.to));
    const Cell cell = cellAt(middle, GRASS_CELL);
    const double here = extinctionIn(cell, above(middle), ray.direction);
    const double left = depthAt(share) - columns.spent();
    columns.spend(here * step.length());
    if (!(left < here * step.length())) continue;
    nearest = {step.from + std::max(left, 0.0) / here, Label::GRASS, 0, -1, BLADE_COSINE};
  }
  return std::min(columns.at(), nearest.distance);
}

}  // namespace vegetation_sim::scan
