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

// Part of a ray that begins above the ground and does not end above it.
template <class Height>
class Crossing {
 public:
  Crossing(const Height& height, double from, double to)
      : height_(height), from_(from), to_(to), above_(height(from)), below_(height(to)) {}

  // Returns a place within CLOSE of the ground that is not above it. The place of a straight line
  // is tried first; where this leaves more than half of the part, so is the middle.
  double narrow() {
    while (to_ - from_ > CLOSE) {
      const double size = to_ - from_, way = size * above_ / (above_ - below_);
      divideAt(std::min(std::max(from_ + way, from_ + 0.5 * CLOSE), to_ - 0.5 * CLOSE));
      if (to_ - from_ > 0.5 * size) divideAt(0.5 * (from_ + to_));
    }
    return to_;
  }

 private:
  void divideAt(double at) {
    const double height = height_(at);
    (height > 0.0 ? from_ : to_) = at;
    (height > 0.0 ? above_ : below_) = height;
  }
  const Height& height_;
  double from_, to_, above_, below_;
};

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
  place = origin + Crossing(heightAt, from, to).narrow() * along;
  return true;
}

}  // namespace vegetation_sim::terrain
