// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/contact/rounded_box.h"

#include <cmath>

namespace vegetation_sim::physics {
namespace {

// Every point of a bar that lies flat on a face is nearest; this slight curvature selects the
// middle one.
constexpr double BOWL = 2e-3;  // [1/m]
constexpr int BISECTIONS = 36;
// The side of a contact may change until the overlap is this part of the body's thickness.
constexpr double SHALLOW = 0.5;
constexpr double TOUCHING = 1e-5;  // [m]
constexpr int MOST_ADVANCES = 48;
// A shorter way to the surface has no direction, since its square is no normal number.
constexpr double NO_DISTANCE = 1e-150;  // [m]

Bar between(const Vec3& base, const Vec3& tip, const Bar& like) {
  const Vec3 span = tip - base;
  const double span_length = std::max(length(span), 1e-9);
  return {base, span / span_length, span_length, like.base_radius, like.tip_radius};
}

}  // namespace

double supportOf(const RoundedBox& box, const Vec3& side) {
  return std::fabs(side.x()) * box.half.x() + std::fabs(side.y()) * box.half.y() +
         std::fabs(side.z()) * box.half.z() + box.radius;
}

double signedDistance(const RoundedBox& box, const Vec3& point, Vec3& normal) {
  Vec3 beyond;
  int deepest = 0;
  for (int i = 0; i < 3; ++i) {
    beyond[i] = std::fabs(point[i]) - box.half[i];
    if (beyond[i] > beyond[deepest]) deepest = i;
    const double out = std::max(beyond[i], 0.0);
    normal[i] = point[i] < 0.0 ? -out : out;
  }
  const double distance = length(normal);
  if (distance > NO_DISTANCE) {
    normal /= distance;
    return distance - box.radius;
  }
  normal = Vec3::Zero();
  normal[deepest] = point[deepest] < 0.0 ? -1.0 : 1.0;
  return beyond[deepest] - box.radius;
}

// The distance along the bar is convex, so its slope has one zero.
Proximity nearest(const RoundedBox& box, const Bar& bar) {
  const double taper = (bar.tip_radius - bar.base_radius) / bar.length;
  double low = 0.0, high = bar.length;
  Vec3 normal;
  for (int i = 0; i < BISECTIONS; ++i) {
    const double along = 0.5 * (low + high);
    signedDistance(box, bar.at(along), normal);
    const double slope = dot(normal, bar.axis) - taper + 2.0 * BOWL * (along - 0.5 * bar.length);
    (slope > 0.0 ? high : low) = along;
  }
  // Where the slope has one sign all along, the nearest point is the end itself.
  const double along = low == 0.0 ? 0.0 : high == bar.length ? bar.length : 0.5 * (low + high);
  const double distance = signedDistance(box, bar.at(along), normal);
  return {along, normal, distance - bar.radiusAt(along)};
}

Proximity nearest(const RoundedBox& box, const Bar& bar, const Vec3& side) {
  Proximity out = nearest(box, bar);
  const bool deep = out.gap < -SHALLOW * box.thickness();
  if (!deep && dot(out.normal, side) > 0.0) return out;
  out.normal = side;
  out.gap = dot(bar.at(out.along), side) - supportOf(box, side) - bar.radiusAt(out.along);
  return out;
}

// Conservative advancement: no point approaches faster than the faster end moves.
Meeting sweep(const RoundedBox& box, const Bar& bar, const Vec3& base_velocity,
              const Vec3& tip_velocity, double horizon) {
  const Vec3 tip = bar.at(bar.length);
  const double speed = std::max(length(base_velocity), length(tip_velocity));
  Meeting out;
  for (int i = 0; i < MOST_ADVANCES; ++i) {
    const Vec3 base_then = bar.base + out.time * base_velocity;
    out.there = nearest(box, between(base_then, tip + out.time * tip_velocity, bar));
    out.met = out.there.gap <= TOUCHING;
    if (out.met || speed <= 0.0) return out;
    out.time += out.there.gap / speed;
    if (out.time > horizon) return out;
  }
  return out;
}

}  // namespace vegetation_sim::physics
