// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/limb_error.h"

#include <algorithm>

namespace vegetation_sim::crowd {
namespace {

constexpr std::size_t NUMBERS = 12, ENDS = 2 * PARTS;

using EndShifts = std::array<Vec3, ENDS>;

// The numbers of a walker that are rounded.
std::array<double*, NUMBERS> numbersOf(Walker& w) {
  Foot &left = w.feet[0], &right = w.feet[1];
  Point& left_at = left.stands ? left.planted : left.offset;
  Point& right_at = right.stands ? right.planted : right.offset;
  return {&w.position.x, &w.position.y, &left_at.x, &left_at.y, &right_at.x,  &right_at.y,
          &w.velocity.x, &w.velocity.y, &w.heading, &w.gait,    &w.turn_rate, &w.height};
}

// Their largest differences, in the same order.
std::array<double, NUMBERS> limitsOf(const WalkerRounding& r) {
  return {r.place,    r.place,    r.place,   r.place, r.place,     r.place,
          r.velocity, r.velocity, r.heading, r.gait,  r.turn_rate, r.height};
}

/// Draws bodies near a walker as displays do.
struct Drawing {
  const terrain::HeightMap& terrain;
  const MotionStyles& styles;
  double seconds, ground;

  Skeleton of(const Walker& w) const {
    Skeleton out = skeletonOf(w, terrain, styles, seconds);
    const double rise = ground - terrain.height(w.position.x, w.position.y);
    for (Limb& limb : out) {
      limb.from.z() += rise;
      limb.to.z() += rise;
    }
    return out;
  }
};

// Raises the shifts of ends to those between two bodies.
void include(const Skeleton& a, const Skeleton& b, EndShifts& out) {
  for (std::size_t i = 0; i < PARTS; ++i) {
    out[2 * i] = out[2 * i].cwiseMax((a[i].from - b[i].from).cwiseAbs());
    out[2 * i + 1] = out[2 * i + 1].cwiseMax((a[i].to - b[i].to).cwiseAbs());
  }
}

EndShifts noShifts() {
  EndShifts out;
  out.fill(Vec3::Zero());
  return out;
}

}  // namespace

double limbErrorOf(const Walker& walker, const terrain::HeightMap& terrain,
                   const MotionStyles& styles, double seconds, const WalkerRounding& rounding) {
  const double ground = terrain.height(walker.position.x, walker.position.y);
  const Drawing drawing{terrain, styles, seconds, ground};
  const Skeleton exact = drawing.of(walker);
  const std::array<double, NUMBERS> limits = limitsOf(rounding);
  EndShifts sum = noShifts();
  for (std::size_t i = 0; i < NUMBERS; ++i) {
    EndShifts own = noShifts();
    for (const double sign : {-1.0, 1.0}) {
      Walker moved = walker;
      *numbersOf(moved)[i] += sign * limits[i];
      include(exact, drawing.of(moved), own);
    }
    for (std::size_t k = 0; k < ENDS; ++k) sum[k] += own[k];
  }
  double largest = 0.0;
  for (Vec3& shift : sum) {
    shift.z() += rounding.ground;
    largest = std::max(largest, shift.norm());
  }
  return largest;
}

}  // namespace vegetation_sim::crowd
