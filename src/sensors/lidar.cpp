// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/lidar.h"

#include <algorithm>

#include "sensors/traversal/bundle_walk.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

SinCos elevationOf(const Beams& b, int ring) {
  const double up = b.rings > 1 ? static_cast<double>(ring) / (b.rings - 1) : 0.5;
  return sinCos(b.elevation_low + up * (b.elevation_high - b.elevation_low));
}

SinCos azimuthOf(const Beams& b, int column) {
  return sinCos(b.azimuth_low + (b.azimuth_high - b.azimuth_low) * column / b.columns);
}

Vec3 along(const SinCos& elevation, const SinCos& azimuth) {
  return {elevation.cos * azimuth.cos, elevation.cos * azimuth.sin, elevation.sin};
}

}  // namespace

void describe(FieldVisitor& v, Beams& b) {
  v.integer("rings", b.rings, "", {1, 512});
  v.number("elevation_low", b.elevation_low, "rad", {-1.5707, 1.5707});
  v.number("elevation_high", b.elevation_high, "rad", {-1.5707, 1.5707});
  v.integer("columns", b.columns, "", {1, 14400});
  v.number("azimuth_low", b.azimuth_low, "rad", {-6.2832, 6.2832});
  v.number("azimuth_high", b.azimuth_high, "rad", {-6.2832, 6.2832});
  v.number("range_min", b.range_min, "m", {0.0, 100.0});
  v.number("range_max", b.range_max, "m", {0.1, 500.0});
}

void check(const Beams& b, const std::string& context, Faults& faults) {
  const auto ordered = [&](const char* low, double at, const char* high, double end, bool may) {
    if (!(at < end || (may && at == end)))
      faults.add(context + high + " = " + std::to_string(end) + " is not above " + low + " = " +
                 std::to_string(at));
  };
  ordered("elevation_low", b.elevation_low, "elevation_high", b.elevation_high, true);
  ordered("azimuth_low", b.azimuth_low, "azimuth_high", b.azimuth_high, false);
  ordered("range_min", b.range_min, "range_max", b.range_max, false);
  if (b.azimuth_high - b.azimuth_low > 2.0 * PI + 1e-3)
    faults.add(context + "azimuth_high is more than a turn above azimuth_low");
}

void describe(FieldVisitor& v, Lidar& lidar) {
  v.integer("rate", lidar.rate, "Hz", {1, 100});
  describe(v, lidar.beams);
  describe(v, lidar.model);
}

void check(const Lidar& lidar, const std::string& context, Faults& faults) {
  check(lidar.beams, context, faults);
  check(lidar.model, context, faults);
}

Vec3 directionOf(const Beams& b, int ring, int column) {
  return along(elevationOf(b, ring), azimuthOf(b, column));
}

BeamDirections::BeamDirections(const Beams& b) {
  for (int ring = 0; ring < b.rings; ++ring) rings_.push_back(elevationOf(b, ring));
  for (int column = 0; column < b.columns; ++column) columns_.push_back(azimuthOf(b, column));
}

Vec3 BeamDirections::at(int ring, int column) const {
  return along(rings_[static_cast<std::size_t>(ring)], columns_[static_cast<std::size_t>(column)]);
}

BeamTile tileOf(const Beams& b) {
  const double across = (b.azimuth_high - b.azimuth_low) / b.columns;
  const double up = b.rings > 1 ? (b.elevation_high - b.elevation_low) / (b.rings - 1) : 0.0;
  BeamTile out{std::min(b.rings, RayBundle::MOST_RAYS), 1};
  out.columns = RayBundle::MOST_RAYS / out.rings;
  while (out.rings > 1 && out.rings * up > out.columns * across) {
    out.rings = (out.rings + 1) / 2;
    out.columns = RayBundle::MOST_RAYS / out.rings;
  }
  return out;
}

double timeOf(const Beams& b, int column, double turn) {
  return turn * (b.azimuth_high - b.azimuth_low) / (2.0 * PI) * column / b.columns;
}

Lidar planeOf(const Lidar& lidar) {
  Lidar out = lidar;
  out.beams.rings = 1;
  out.beams.elevation_low = out.beams.elevation_high = 0.0;
  if (out.model.returns == ReturnMode::BOTH) out.model.returns = ReturnMode::STRONGEST;
  return out;
}

}  // namespace vegetation_sim::scan
