// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/ground_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vegetation_sim::terrain {
namespace {

constexpr double CLOSE = 1e-3;  // [m]
constexpr double NEVER = std::numeric_limits<double>::infinity();
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

// Returns up to which distance along a ray, from one at which it is above the ground, it stays
// above the highest place of the block that it is in.
double safeInBlock(const HeightMap& ground, const Vec3& origin, const Vec3& along, double from) {
  const Vec3 place = origin + from * along;
  const HeightMap::Block block = ground.blockAt(place.x(), place.y());
  const double above = place.z() - block.top - CLOSE;
  if (!(above > 0.0)) return from;
  double way = along.z() < 0.0 ? above / -along.z() : NEVER;
  if (along.x() != 0.0)
    way = std::min(way, ((along.x() > 0.0 ? block.max_x : block.min_x) - place.x()) / along.x());
  if (along.y() != 0.0)
    way = std::min(way, ((along.y() > 0.0 ? block.max_y : block.min_y) - place.y()) / along.y());
  return from + way;
}

// Returns a place on a ray within CLOSE of where it meets the ground, and not above it. It must be
// above the ground at `from`, and not at `to`. The method is that of the false position, which
// halves the height at an end that was kept (Dowell and Jarratt 1971).
template <class Height>
double narrow(const Height& heightAt, double from, double to) {
  double above = heightAt(from), below = heightAt(to);
  while (to - from > CLOSE) {
    const double way = (to - from) * above / (above - below);
    const double at = std::min(std::max(from + way, from + 0.5 * CLOSE), to - 0.5 * CLOSE);
    const double height = heightAt(at);
    if (height > 0.0) {
      from = at;
      above = height;
      below *= 0.5;
    } else {
      to = at;
      below = height;
      above *= 0.5;
    }
  }
  return to;
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
  const double step =
      std::max(CLOSE, ground.isFlat() ? part.to - part.from : 0.5 * ground.resolution());
  // How fast the ray may approach the ground.
  const double level = std::sqrt(along.x() * along.x() + along.y() * along.y());
  const double approach = ground.steepest() * level - along.z();
  double from = part.from, to = from;
  const auto heightAt = [&](double at) {
    if (ground.isFlat()) return origin.z() + at * along.z();
    return above(ground, origin + at * along);
  };
  for (double height = heightAt(to); height > 0.0; height = heightAt(to)) {
    if (to >= part.to) return false;
    // Steps that cannot reach the ground are taken at once.
    double safe = approach > 0.0 ? to + SAFE * height / approach : NEVER;
    if (safe < part.to && !ground.isFlat())
      safe = std::max(safe, safeInBlock(ground, origin, along, to));
    if (safe > part.to) return false;
    const double steps = std::max(1.0, std::ceil((safe - to) / step));
    from = to + (steps - 1.0) * step;
    to = std::min(part.to, to + steps * step);
  }
  to = narrow(heightAt, from, to);
  place = origin + to * along;
  return true;
}

}  // namespace vegetation_sim::terrain
