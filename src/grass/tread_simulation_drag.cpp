// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The drag of grass on what moves through it.
#include <algorithm>

#include "grass/tread_simulation.h"

namespace vegetation_sim::grass {

double TreadSimulation::resistanceAt(const Point& place, Nanoseconds stamp) const {
  const Features f = layout_.map->at(place.x, place.y);
  const double crush = double{tread_.at(place, stamp).tilt} / BEND_LIMIT;
  return drag_ * f.density * heightAt(place) * std::max(0.0, 1.0 - crush);
}

double TreadSimulation::heightAt(const Point& place) const {
  return std::min(layout_.map->at(place.x, place.y).height, double{tread_.cuts().at(place).height});
}

std::vector<Drag> TreadSimulation::drags() const {
  std::vector<Drag> out;
  for (const auto& [name, source] : sources_) {
    if (source.last.body_frame.empty()) continue;
    Drag drag{name, source.last.body_frame, source.last.position, Vec3::Zero()};
    Vec3 ahead = source.last.position;
    const Vec3 flat(source.velocity.x(), source.velocity.y(), 0.0);
    const double speed = length(flat);
    if (source.down && speed > 0.0) {
      // The drag is that of the grass ahead, not of what is trodden already.
      ahead += (source.last.law.reach / speed) * flat;
      const double width = 2.0 * source.last.law.radius;
      drag.force = -width * resistanceAt({ahead.x(), ahead.y()}, stamp_) * flat;
    }
    if (tread_.owners().ownsPlace(ahead.x(), ahead.y())) out.push_back(std::move(drag));
  }
  return out;
}

}  // namespace vegetation_sim::grass
