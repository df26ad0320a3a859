// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/detail/detail_demand.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

std::vector<DetailDemand::Place> placesOf(const Settings& settings, const Bodies& bodies) {
  std::vector<DetailDemand::Place> out;
  for (const auto& entry : bodies)
    out.push_back({entry.second.pose.position, settings.robot_range, settings.robot_tolerance});
  return out;
}

int fixedLevel(const Settings& settings) {
  return std::min(settings.fixed_level, settings.highest_level);
}

}  // namespace

void describe(FieldVisitor& v, Settings& s) {
  v.number("tolerance", s.tolerance, "pixel", {0.01, 1000.0});
  v.integer("fixed_level", s.fixed_level, "", {0, MAX_DEPTHS});
  v.integer("highest_level", s.highest_level, "", {0, MAX_DEPTHS});
  v.number("robot_tolerance", s.robot_tolerance, "m", {1e-4, 10.0});
  v.number("robot_range", s.robot_range, "m", {0.0, 100.0});
  describe(v, s.budget);
}

std::size_t changesWithin(Nanoseconds from, Nanoseconds to) {
  constexpr double MANY = 1e9;  // more than there can be trees
  const double changes = to > from ? DELTA_BYTES / ENTRY_BYTES * secondsBetween(from, to) : MANY;
  return static_cast<std::size_t>(std::clamp(changes, 1.0, MANY));
}

double DetailDemand::pixelsPerMetre(const Vec3& centre, double reach, double tolerance) const {
  double out = 0.0;
  for (const Viewpoint& eye : eyes) {
    if (!sees(eye, centre, 2.0 * reach)) continue;  // twice: the whole tree with a margin
    const double distance = length(eye.position - centre) - reach;
    out = std::max(out, vegetation_sim::pixelsPerMetre(eye, distance));
  }
  for (const Place& place : places) {
    const double distance = length(place.centre - centre) - reach;
    if (distance < place.range) out = std::max(out, tolerance / place.tolerance);
  }
  return out;
}

DetailDemand worldDemand(const Settings& settings, const Bodies& bodies) {
  DetailDemand out;
  out.places = placesOf(settings, bodies);
  out.base = fixedLevel(settings);
  out.frame_time_binds = false;
  return out;
}

DetailDemand sensorDemand(const Settings& settings, const Bodies& bodies,
                          const std::map<std::string, Sensor>& sensors) {
  DetailDemand out = worldDemand(settings, bodies);
  for (const auto& entry : sensors)
    out.places.push_back({entry.second.position, entry.second.range, entry.second.tolerance});
  return out;
}

DetailDemand viewDemand(const Settings& settings, const Bodies& bodies,
                        const std::vector<Viewpoint>& viewers) {
  DetailDemand out;
  out.places = placesOf(settings, bodies);
  out.eyes = viewers;
  out.base = out.eyes.empty() ? fixedLevel(settings) : 0;
  return out;
}

}  // namespace vegetation_sim::forest
