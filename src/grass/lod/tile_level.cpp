// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/lod/tile_level.h"

#include <algorithm>

#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/grass/blades/blade.h"

namespace vegetation_sim::grass {
namespace {

// All blades are drawn if their spacing is at least this many tolerances.
constexpr double APART = 8.0;
// Largest distance of a 90 degree arc from n chords, times n^2, per length of the arc.
constexpr double CHORD_ERROR = PI / 16.0;
// Layers replace strips between these elevations [rad].
constexpr double FLAT_VIEW = 0.5, STEEP_VIEW = 0.9;

}  // namespace

double omission(const TileDetail& detail, TileModel tier) {
  switch (tier) {
    case TileModel::TEXTURE:
      return std::max(detail.height, detail.blade_spacing);
    case TileModel::STRIPS:
      return detail.blade_spacing;
    default:
      return 0.0;
  }
}

TileModel chooseTileModel(const TileDetail& detail, double pixels_per_metre, double tolerance,
                          TileModel current) {
  const auto error = [&](int tier) {
    return pixels_per_metre * omission(detail, static_cast<TileModel>(tier));
  };
  int wanted = 0;
  while (wanted < static_cast<int>(TileModel::BLADES) && error(wanted) > tolerance) ++wanted;
  int tier = static_cast<int>(current);
  if (wanted >= tier) return static_cast<TileModel>(wanted);
  while (tier > wanted && error(tier - 1) <= HYSTERESIS * tolerance) --tier;
  return static_cast<TileModel>(tier);
}

double bladeShare(const TileDetail& detail, double pixels_per_metre, double tolerance) {
  const double apart = detail.blade_spacing * pixels_per_metre / tolerance;
  return std::min(1.0, std::max(LEAST_SHARE, apart / APART));
}

int bladeSegments(double height, double pixels_per_metre, double tolerance) {
  for (const int segments : {1, 2, 3})
    if (CHORD_ERROR * height * pixels_per_metre <= tolerance * segments * segments) return segments;
  return LINKS;
}

double placeAt(const TileModelState& state, Nanoseconds stamp, double transition) {
  const double target = static_cast<double>(state.target), gap = target - double{state.place};
  if (stamp <= state.since) return double{state.place};
  const double way = transition > 0.0 ? secondsBetween(state.since, stamp) / transition : 2.0;
  return gap > 0.0 ? std::min(target, double{state.place} + way)
                   : std::max(target, double{state.place} - way);
}

void setTileModel(TileModelState& state, TileModel target, Nanoseconds stamp, double transition) {
  if (target == state.target) return;
  state.place = static_cast<float>(placeAt(state, stamp, transition));
  state.since = stamp;
  state.target = target;
}

Morph morphAt(double place) {
  Morph out;
  out.blades = place > 1.0;
  out.slide = 1.0 - smoothStep(place - 1.0);
  out.strip = place > 1.0 ? out.slide : smoothStep(place);
  return out;
}

double layerWeight(double elevation) {
  return smoothStep((elevation - FLAT_VIEW) / (STEEP_VIEW - FLAT_VIEW));
}

int layerCount(double height, double pixels_per_metre, double tolerance) {
  const double steps = height * pixels_per_metre / (2.0 * tolerance);
  return static_cast<int>(std::min(double{MOST_LAYERS}, std::max(1.0, steps)));
}

}  // namespace vegetation_sim::grass
