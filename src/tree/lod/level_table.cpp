// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/lod/level_table.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {
namespace {

constexpr int TREES_PER_SPECIES = 6;  // trees measured per species
constexpr int DIRECTIONS = 4;         // wind directions per tree
constexpr double WEAK_WIND = 0.5;     // [m/s] weak enough that no joint nears its limit
constexpr double STRANGER = 1.1;      // margin for trees that were not measured

// Scales of measured trees; tables at other scales are interpolated.
constexpr std::array<double, 11> GRID{0.05, 0.1, 0.2, 0.35, 0.6, 1.0, 1.6, 2.5, 4.0, 8.0, 20.0};

// Returns the last grid point at or below a scale that has one above it.
std::size_t gridIndex(double scale) {
  std::size_t i = 0;
  while (i + 2 < GRID.size() && GRID[i + 1] <= scale) ++i;
  return i;
}

// Raises omitted[n] to the largest displacement of a tip when the joints of depth n or more are
// fixed, per wind speed.
void measureTree(const Tree& tree, LevelTable& table) {
  for (int direction = 0; direction < DIRECTIONS; ++direction) {
    const SinCos a = sinCosTurns(static_cast<double>(direction) / (2 * DIRECTIONS));
    wind::Instant wind;
    wind.mean = Vec3(WEAK_WIND * a.cos, WEAK_WIND * a.sin, 0.0);
    Weights weights;
    weights.fill(1.0);
    const std::vector<Pose> full = poseBranches(tree, wind, weights);
    for (auto n = static_cast<std::size_t>(tree.skeleton.depths()); n-- > 0;) {
      weights[n] = 0.0;
      const std::vector<Pose> cut = poseBranches(tree, wind, weights);
      for (std::size_t i = 0; i < full.size(); ++i) {
        const Branch& branch = tree.skeleton.branches[i];
        const double moved = length(tipOf(branch, full[i]) - tipOf(branch, cut[i]));
        table.omitted[n] = std::max(table.omitted[n], STRANGER * moved / WEAK_WIND);
      }
    }
  }
}

double branchesBelow(const Skeleton& skeleton, std::size_t depth) {
  if (depth == 0) return 0.0;
  return skeleton.depth_end[std::min(depth, skeleton.depth_end.size()) - 1];
}

}  // namespace

LevelTable measureLevels(const Species& species, const MotionLaw& law, double scale) {
  LevelTable out;
  out.height = out.reach = 0.0;
  for (int sample = 0; sample < TREES_PER_SPECIES; ++sample) {
    TreeSeed seed;
    seed.seed = static_cast<std::uint64_t>(sample) + 1;
    seed.scale = scale;
    const Tree tree = growTree(seed, species, law);
    measureTree(tree, out);
    for (std::size_t n = 0; n < out.branches.size(); ++n)
      out.branches[n] += branchesBelow(tree.skeleton, n) / TREES_PER_SPECIES;
    out.height = std::max(out.height, tree.skeleton.height);
    out.reach = std::max(out.reach, tree.skeleton.reach);
  }
  return out;
}

void LevelScales::measure(const Species& species, const MotionLaw& law, double scale) {
  const std::size_t below = gridIndex(scale);
  for (const std::size_t i : {below, below + 1})
    if (!tables_.count(i)) tables_[i] = measureLevels(species, law, GRID[i]);
}

LevelTable LevelScales::at(double scale) const {
  const std::size_t below = gridIndex(scale);
  const LevelTable &a = tables_.at(below), &b = tables_.at(below + 1);
  const double f = saturate((scale - GRID[below]) / (GRID[below + 1] - GRID[below]));
  LevelTable out;
  for (std::size_t n = 0; n < out.omitted.size(); ++n) {
    out.omitted[n] = a.omitted[n] + f * (b.omitted[n] - a.omitted[n]);
    out.branches[n] = a.branches[n] + f * (b.branches[n] - a.branches[n]);
  }
  out.height = a.height + f * (b.height - a.height);
  out.reach = a.reach + f * (b.reach - a.reach);
  return out;
}

PredictedError LevelScales::responseErrorAt(const Species& species, const MotionLaw& law,
                                            double scale, const wind::GustSpectrum& spectrum) {
  const std::size_t below = gridIndex(scale);
  const auto lag = [&](std::size_t i) {
    auto known = response_errors_.find(i);
    if (known == response_errors_.end())
      known = response_errors_.emplace(i, measureResponseError(species, law, GRID[i])).first;
    return known->second.in(spectrum);
  };
  const PredictedError a = lag(below);
  const double f = saturate((scale - GRID[below]) / (GRID[below + 1] - GRID[below]));
  if (f == 0.0) return a;  // trees of the species' own size need one table
  const PredictedError b = lag(below + 1);
  const auto mix = [f](double from, double to) { return from + f * (to - from); };
  return {mix(a.procedural, b.procedural),
          mix(a.modal, b.modal),
          mix(a.fine, b.fine),
          {mix(a.bend.procedural, b.bend.procedural), mix(a.bend.modal, b.bend.modal)}};
}

int chooseLevel(const LevelTable& table, double speed, double pixels_per_metre, double tolerance,
                int current) {
  const int full = MAX_DEPTHS;
  const double factor = speed * pixels_per_metre;
  const auto error = [&](int level) {
    return factor * table.omitted[static_cast<std::size_t>(level)];
  };
  int wanted = 0;
  while (wanted < full && error(wanted) > tolerance) ++wanted;
  current = std::min(current, full);
  if (wanted < current && error(current - 1) > HYSTERESIS * tolerance) return current;
  return wanted;
}

}  // namespace vegetation_sim::forest
