// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "sensors/geometry/box.h"
#include "sensors/grass/grass_volume.h"
#include "sensors/media/beer_lambert.h"
#include "sensors/media/cell_walk.h"

namespace vegetation_sim::scan {
namespace {

constexpr double BLADE_STEP = 0.05;       // longest part of a ray with one extinction [m]
constexpr double STEEP = 0.9;             // vertical component from which a ray stays in a column
constexpr double LONGEST_CROSSING = 3.3;  // of a ray that is not steep, in widths of the column
constexpr double BLADE_STRETCH = 0.4;     // part of a ray with one bound [m]

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
double GrassVolume::marchBlades(const Ray& ray, double from, const BladeColumns& form, Cells cells,
                                Hit& nearest) const {
  ColumnWalk columns(ray, form.width, static_cast<std::uint32_t>(layout_.seed) ^ BLADE_SEED);
  while (from < std::min(nearest.distance, form.reach)) {
    const double to = std::min(from + BLADE_STRETCH, nearest.distance);
    const double bound = boundWithin(ray, from, to + LONGEST_CROSSING * form.width);
    if (bound < 0.0) return from;
    if (bound > 0.0 || cells == Cells::ALL) {
      columns.enter(from);
      from = meetColumns(columns, to, cells == Cells::ALL ? Box::ENDLESS : bound, nearest);
    } else {
      columns.leave();
      from = to;
    }
  }
  return from;
}

// A column stops a ray at the optical depth of its random number, summed over all of the ray within
// it. Extinction falls with the height, so that a column ends like a blade.
double GrassVolume::meetColumns(ColumnWalk& columns, double to, double bound, Hit& nearest) const {
  const Ray& ray = columns.ray();
  const bool steep = std::fabs(ray.direction.z()) > STEEP;
  const double end = std::min(to, nearest.distance), most = steep ? end : nearest.distance;
  while (columns.at() < end) {
    const ColumnWalk::Step step = columns.next(most);
    if (!steep && !mayBeBelow(bound * step.length(), step.share)) continue;
    double spent = step.spent;
    for (double from = step.from; from < step.to; from += BLADE_STEP) {
      const double part = std::min(BLADE_STEP, step.to - from);
      const Vec3 middle = ray.at(from + 0.5 * part);
      const double here = extinctionIn(cellAt(middle, GRASS_CELL), above(middle), ray.direction);
      const double left = depthAt(step.share) - spent;
      spent += here * part;
      if (!(left < here * part)) continue;
      nearest = {from + std::max(left, 0.0) / here, Label::GRASS, 0, -1, BLADE_COSINE};
      return nearest.distance;
    }
    if (!step.ends) columns.setSpent(spent);
  }
  return std::min(columns.at(), nearest.distance);
}

}  // namespace vegetation_sim::scan
