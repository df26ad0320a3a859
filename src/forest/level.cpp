// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/level.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/forest/response.h"
#include "vegetation_sim/forest/skeleton.h"

namespace vegetation_sim::forest {
namespace {

constexpr int SAMPLES = 6;       // trees measured per species
constexpr double NEAREST = 0.5;  // [m] closer than this nothing grows in the picture

// Adds to omitted[n] the displacement of one tip due to all joints of depth n or more.
void addTip(const Skeleton& skeleton, const std::vector<double>& bend, std::size_t tip,
            std::vector<double>& omitted) {
  const Vec3 end = tipOf(skeleton.branches[tip], skeleton.branches[tip].rest);
  std::vector<double> by_depth(omitted.size(), 0.0);
  for (int i = static_cast<int>(tip); i >= 0;
       i = skeleton.branches[static_cast<std::size_t>(i)].parent) {
    const Branch& joint = skeleton.branches[static_cast<std::size_t>(i)];
    by_depth[static_cast<std::size_t>(joint.depth)] +=
        bend[static_cast<std::size_t>(i)] * length(end - joint.rest.position);
  }
  double sum = 0.0;
  for (std::size_t n = omitted.size(); n-- > 0;) {
    sum += by_depth[n];
    omitted[n] = std::max(omitted[n], sum);
  }
}

}  // namespace

LevelState LevelState::settled(int level) {
  LevelState out;
  out.level = level;
  for (int d = 0; d < MAX_DEPTHS; ++d)
    out.blend[static_cast<std::size_t>(d)] = d < level ? 1.f : 0.f;
  return out;
}

std::array<double, MAX_DEPTHS> blendAt(const LevelState& state, Nanoseconds stamp,
                                       double transition) {
  const double moved = std::max(0.0, secondsBetween(state.since, stamp) / transition);
  std::array<double, MAX_DEPTHS> out;
  for (int d = 0; d < MAX_DEPTHS; ++d) {
    const double from = state.blend[static_cast<std::size_t>(d)];
    out[static_cast<std::size_t>(d)] = saturate(d < state.level ? from + moved : from - moved);
  }
  return out;
}

Weights weightsAt(const LevelState& state, Nanoseconds stamp, const MotionLaw& law) {
  Weights out = blendAt(state, stamp, law.transition);
  if (static_cast<TransitionShape>(law.transition_shape) == TransitionShape::SMOOTH)
    for (double& weight : out) weight = smoothStep(weight);
  return out;
}

void setLevel(LevelState& state, int level, Nanoseconds stamp, double transition) {
  const auto now = blendAt(state, stamp, transition);
  for (std::size_t d = 0; d < MAX_DEPTHS; ++d) state.blend[d] = static_cast<float>(now[d]);
  state.level = level;
  state.since = stamp;
}

bool isSettled(const LevelState& state, Nanoseconds stamp, double transition) {
  const auto now = blendAt(state, stamp, transition);
  for (int d = 0; d < MAX_DEPTHS; ++d)
    if (now[static_cast<std::size_t>(d)] != (d < state.level ? 1.0 : 0.0)) return false;
  return true;
}

int movingDepths(const Weights& weights) {
  int out = MAX_DEPTHS;
  while (out > 0 && weights[static_cast<std::size_t>(out) - 1] <= 0.0) --out;
  return out;
}

LevelTable measureLevels(const Species& species, const MotionLaw& law) {
  LevelTable out;
  out.omitted.assign(static_cast<std::size_t>(species.depths()), 0.0);
  out.branches.assign(static_cast<std::size_t>(species.depths()) + 1, 0.0);
  out.height = out.reach = 0.0;
  for (int sample = 0; sample < SAMPLES; ++sample) {
    TreeSeed seed;
    seed.seed = static_cast<std::uint64_t>(sample) + 1;
    const Skeleton skeleton = grow(seed, species);
    const std::vector<Response> response = windResponse(skeleton, species, law);
    std::vector<double> bend(response.size());
    for (std::size_t i = 0; i < bend.size(); ++i)
      bend[i] = std::sqrt(dot(response[i].first, response[i].first) +
                          dot(response[i].second, response[i].second));
    for (std::size_t i = 0; i < bend.size(); ++i)
      if (skeleton.branches[i].next < 0) addTip(skeleton, bend, i, out.omitted);
    for (int d = 0; d < skeleton.depths(); ++d)
      out.branches[static_cast<std::size_t>(d) + 1] +=
          static_cast<double>(skeleton.depth_end[static_cast<std::size_t>(d)]) / SAMPLES;
    out.height = std::max(out.height, skeleton.height);
    out.reach = std::max(out.reach, skeleton.reach);
  }
  out.omitted.push_back(0.0);
  return out;
}

double pixelsPerMetre(const Eye& eye, double distance) {
  return eye.pixels_per_radian / std::max(distance, NEAREST);
}

int chooseLevel(const LevelTable& table, double scale, double speed, double pixels_per_metre,
                double tolerance, int current) {
  const int full = static_cast<int>(table.omitted.size()) - 1;
  const double factor = scale * speed * pixels_per_metre;
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
