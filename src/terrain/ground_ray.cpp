// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/ground_ray.h"

#include <algorithm>

namespace vegetation_sim::terrain {
namespace {

constexpr double CLOSE = 1e-3;  // [m]
constexpr double SAFE = 0.999;  // more than the rounding of heights and slopes allows

double above(const HeightMap& ground, const Vec3& place) {
  return place.z() - ground.height(place.x(), place.y());
}

// The part of a ray between two heights, as distances along it; empty if from > to.
struct Stretch {
  double from, to;
};

Stretch between(double low, double high, double z, double rise, double reach) {
  if (rise == 0.0) return z >= low && z <= high ? Stretch{0.0, reach} : Stretch{1.0, 0.0};
  const double a = (low - z) / rise, b = (high - z) / rise;
  return {std::max(0.0, std::min(a, b)), std::min(reach, std::max(a, b))};
}

}  // namespace

bool meetGround(const HeightMap& ground, const Vec3& origin, const Vec3& direction, double reach,
                Vec3& place) {
  const double size = length(direction);
  if (!(size > 0.0) || !origin.allFinite() || !direction.allFinite()) return false;
  const Vec3 along = direction / size;
  if (above(ground, origin) < 0.0) return false;
  const Bounds box = ground.bounds();
  // A margin around the box keeps rounding at its faces from mattering.
  const Stretch part = between(box.min_z - CLOSE, box.max_z + CLOSE, origin.z(), along.z(), reach);
  if (part.from > part.to) return false;
  const double step = ground.isFlat() ? part.to - part.from : 0.5 * ground.resolution();
  // How fast the ray may approach the ground.
  const double level = std::sqrt(along.x() * along.x() + along.y() * along.y());
  const double approach = ground.steepest() * level - along.z();
  double from = part.from, to = from;
  const auto heightAt = [&](double at) {
    if (ground.isFlat()) return origin.z() + at * along.z();
    return above(ground, origin + at * along);
  };
  for (double height = heightAt(to); height > 0.0; height = heightAt(to)) {
    // Steps that cannot reach the ground are taken without a look at it.
    const double safe = approach > 0.0 ? to + SAFE * height / approach : part.to;
    do {
      if (to >= part.to) return false;
      from = to;
      to = std::min(part.to, to + std::max(step, CLOSE));
    } while (to < safe);
  }
  while (to - from > CLOSE) {
    const double middle = 0.5 * (from + to);
    const bool over = heightAt(middle) > 0.0;
    from = over ? middle : from;
    to = over ? to : middle;
  }
  place = origin + to * along;
  return true;
}

}  // namespace vegetation_sim::terrain
