// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/wind_stroke.h"

#include <algorithm>

namespace vegetation_sim::view {
namespace {

constexpr double LEAD = 1.0;           // [s] delay until all subscribers have it
constexpr double CLICK = 0.5;          // [m] shorter strokes are clicks
constexpr double STRONGEST = 40.0;     // [m/s]
constexpr double LONGEST_GUST = 60.0;  // [s]

}  // namespace

wind::Primitive gustOf(const WindStroke& stroke, Nanoseconds now) {
  Vec3 way = stroke.to - stroke.from;
  way.z() = 0.0;
  const double length = way.norm();
  wind::Primitive out;
  out.kind = wind::Kind::GUST;
  out.name = "mouse_gust";
  const Vec3 direction = length < CLICK ? Vec3(Vec3::UnitX()) : Vec3(way / length);
  out.velocity = (length < CLICK ? stroke.speed : std::min(length, STRONGEST)) * direction;
  out.radius = stroke.radius;
  out.front_speed = 9.0;
  out.rise_length = 6.0;
  out.plateau_length = 10.0;
  out.decay_length = 20.0;
  const Vec3 start = stroke.from - stroke.radius * direction;
  out.t_off = now + fromSeconds(LONGEST_GUST);
  out.trajectory = {{now, start}};
  return out;
}

wind::Primitive tornadoOf(const WindStroke& stroke, Nanoseconds now) {
  wind::Primitive out;
  out.kind = wind::Kind::TORNADO;
  out.name = "mouse_tornado";
  out.radius = stroke.radius;
  out.core_radius = 0.2 * stroke.radius;
  out.speed = stroke.speed;
  const Nanoseconds begin = now + fromSeconds(LEAD);
  out.t_off = begin + fromSeconds(stroke.duration);
  out.trajectory = {{begin, stroke.from}, {out.t_off, stroke.to}};
  return out;
}

}  // namespace vegetation_sim::view
