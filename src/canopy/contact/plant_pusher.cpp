// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/contact/plant_pusher.h"

#include <algorithm>
#include <cmath>

#include "forest/contact/contact_body.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double SQUARE = 4.0;         // [m] edge
constexpr double LONGEST_STEP = 0.01;  // [s]
constexpr double LONGEST_WAY = 0.01;   // of a body in a step [m]
constexpr int MOST_STEPS = 64;         // between two ticks
constexpr Nanoseconds AHEAD = NANOSECONDS_PER_SECOND / 2;

// Radius around the foot in which bodies can touch the fibres.
double reachOf(const Fibres& fibres, bool leans) {
  return 1.5 * fibres.half + fibres.edge() + (leans ? fibres.length : 0.0);
}

double wayOf(const forest::Body& body, double seconds) {
  const double reach = shapeOf(body).reach();
  return seconds * (length(body.velocity) + reach * length(body.spin));
}

int stepsFor(const std::vector<const forest::Body*>& bodies, double seconds) {
  double steps = seconds / LONGEST_STEP;
  for (const forest::Body* body : bodies)
    steps = std::max(steps, wayOf(*body, seconds) / LONGEST_WAY);
  return static_cast<int>(std::clamp(std::ceil(steps), 1.0, static_cast<double>(MOST_STEPS)));
}

std::vector<PosedBody> poseAll(const std::vector<const forest::Body*>& bodies, Nanoseconds stamp) {
  std::vector<PosedBody> out;
  out.reserve(bodies.size());
  for (const forest::Body* body : bodies)
    out.push_back({shapeOf(*body), poseAt(*body, stamp), body->velocity, body->spin});
  return out;
}

// No plant is farther than 1000 km from the origin; a body may be anywhere.
int squareOf(double coordinate) {
  return static_cast<int>(std::floor(std::clamp(coordinate, -1e8, 1e8) / SQUARE));
}

bool allRest(const std::vector<Cluster>& clusters) {
  return std::all_of(clusters.begin(), clusters.end(),
                     [](const Cluster& cluster) { return cluster.rests(); });
}

}  // namespace

void PlantPusher::sortPlants() {
  if (sorted_) return;
  sorted_ = true;
  for (std::uint32_t id = 0; id < plants_.size(); ++id) {
    if (!(lawOf(id).stiffness > 0.0)) continue;
    const Vec3& foot = plants_[id].position;
    squares_[{squareOf(foot.x()), squareOf(foot.y())}].push_back(id);
    largest_ = std::max(largest_, reachOf(fibresOf(id), true));
  }
}

bool PlantPusher::canReach(std::uint32_t plant, const PushState& state, const forest::Body& body,
                           Nanoseconds from, Nanoseconds to) const {
  const Fibres fibres = fibresOf(plant, state.heightOf(plant));
  const bool leans = state.plants.count(plant) > 0;
  if (fibres.length < SHORTEST_FIBRES) return false;
  const Vec3 offset = poseAt(body, to).position - fibres.foot;
  const double reach = shapeOf(body).reach() + wayOf(body, secondsBetween(from, to));
  const double flat = reach + reachOf(fibres, leans);
  return offset.x() * offset.x() + offset.y() * offset.y() < flat * flat &&
         offset.z() - reach < fibres.length + fibres.edge() && offset.z() + reach > -fibres.edge();
}

// Calls `visit` for each plant that a body may touch until it returns false.
template <class Visit>
void PlantPusher::visitNear(const PushState& state, const forest::Body& body, Nanoseconds from,
                            Nanoseconds to, Visit visit) const {
  const Vec3 at = poseAt(body, to).position;
  const double range = shapeOf(body).reach() + wayOf(body, secondsBetween(from, to)) + largest_;
  const Square low{squareOf(at.x() - range), squareOf(at.y() - range)};
  const Square high{squareOf(at.x() + range), squareOf(at.y() + range)};
  // The squares are ordered by x. A body of any speed costs no more than all squares with plants.
  for (auto square = squares_.lower_bound(low); square != squares_.end(); ++square) {
    if (square->first.first > high.first) return;
    if (square->first.second < low.second || square->first.second > high.second) continue;
    for (const std::uint32_t id : square->second)
      if (canReach(id, state, body, from, to) && !visit(id)) return;
  }
}

bool PlantPusher::isNear(const PushState& state, const forest::Body& body, Nanoseconds now) {
  sortPlants();
  bool found = false;
  visitNear(state, body, now - AHEAD, now, [&](std::uint32_t) {
    found = true;
    return false;
  });
  return found;
}

std::map<std::uint32_t, PlantPusher::Near> PlantPusher::findTouched(const PushState& state,
                                                                    Nanoseconds from,
                                                                    Nanoseconds to) const {
  std::map<std::uint32_t, Near> out;
  for (const auto& entry : state.plants) out[entry.first] = {};
  for (const auto& entry : state.bodies)
    visitNear(state, entry.second, from, to, [&](std::uint32_t id) {
      out[id].push_back(&entry.second);
      return true;
    });
  return out;
}

void PlantPusher::step(std::uint32_t plant, const Fibres& fibres, const Near& near,
                       Nanoseconds from, Nanoseconds to, std::vector<Cluster>& clusters,
                       std::vector<PushForce>& out) const {
  const PushLaw& law = lawOf(plant);
  const double seconds = secondsBetween(from, to);
  const int steps = near.empty() ? 1 : stepsFor(near, seconds);
  std::vector<BodyLoad> loads(near.size());
  for (int i = 1; i <= steps; ++i) {
    const std::vector<PosedBody> bodies = poseAll(near, from + (to - from) * i / steps);
    for (std::size_t cell = 0; cell < clusters.size(); ++cell)
      stepCluster(law, fibres, cell, seconds / steps, bodies, clusters[cell], loads);
  }
  for (std::size_t i = 0; i < near.size(); ++i) {
    const BodyLoad& load = loads[i];
    if (!(load.weight > 0.0)) continue;
    PushForce force;
    force.body = near[i]->id;
    force.frame = near[i]->frame;
    force.plant = plant;
    force.point = load.weighted / load.weight;
    force.force = load.impulse / seconds;
    const Vec3 lever = force.point - poseAt(*near[i], to).position;
    force.torque = load.moment / seconds - cross(lever, force.force);
    force.volume = load.volume / seconds;
    out.push_back(force);
  }
}

std::vector<PushForce> PlantPusher::advance(PushState& state, Nanoseconds from, Nanoseconds to) {
  std::vector<PushForce> out;
  if (state.bodies.empty() && state.plants.empty()) return out;
  sortPlants();
  std::size_t cells = 0;
  for (const auto& entry : state.plants) cells += entry.second.size();
  for (const auto& [plant, near] : findTouched(state, from, to)) {
    const Fibres fibres = fibresOf(plant, state.heightOf(plant));
    const std::size_t count = fibres.cells();
    if (!state.plants.count(plant)) {
      if (cells + count > MOST_CLUSTERS) {
        ++refused_;
        continue;
      }
      cells += count;
    }
    std::vector<Cluster>& clusters = state.plants[plant];
    clusters.resize(count);
    step(plant, fibres, near, from, to, clusters, out);
    if (!allRest(clusters)) continue;
    cells -= count;
    state.plants.erase(plant);
  }
  return out;
}

}  // namespace vegetation_sim::canopy
