// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/governor.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

constexpr double STICKY = 1.5;       // what is held counts so much more
constexpr double LEAST_COST = 1e-6;  // of a step upwards [ms]

/// A step of a plant from one rung to the next that it wants.
struct Step {
  double priority;  // error per millisecond
  double cost;      // [ms]
  std::size_t plant;
  int from, to;
};

int wantedOf(const Plant& plant) {
  return plant.modal ? MODAL_LEVEL : plant.procedural;
}

double errorAt(const Plant& plant, int rung) {
  return plant.error[static_cast<std::size_t>(rung)];
}

double costAt(const Plant& plant, int rung) {
  return plant.cost[static_cast<std::size_t>(rung)];
}

// The plants whose procedural motion is farthest off, as many as there is room for.
void shareModes(std::vector<Plant>& plants, std::size_t room) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    if (!plants[i].modal) continue;
    const double held = plants[i].held == MODAL_LEVEL ? STICKY : 1.0;
    order.emplace_back(-held * errorAt(plants[i], plants[i].procedural), i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t k = room; k < order.size(); ++k) plants[order[k].second].modal = false;
}

// A later step of a plant never goes before an earlier one.
void addSteps(const Plant& plant, std::size_t index, std::vector<Step>& out) {
  double least = 1e300;
  const auto add = [&](int from, int to) {
    const double cost = costAt(plant, to) - costAt(plant, from);
    const double held = plant.held >= to ? STICKY : 1.0;
    least = std::min(least, held * errorAt(plant, from) / std::max(cost, LEAST_COST));
    out.push_back({least, cost, index, from, to});
  };
  for (int rung = 0; rung < plant.procedural; ++rung) add(rung, rung + 1);
  if (plant.modal) add(plant.procedural, MODAL_LEVEL);
}

void fit(std::vector<Plant>& plants, double room) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    Plant& plant = plants[i];
    plant.chosen = plant.resting ? std::min(plant.held, wantedOf(plant)) : 0;
    room -= costAt(plant, plant.chosen);
    if (!plant.resting) addSteps(plant, i, steps);
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) {
    if (a.priority != b.priority) return a.priority > b.priority;
    return a.plant != b.plant ? a.plant < b.plant : a.from < b.from;
  });
  for (const Step& step : steps) {
    Plant& plant = plants[step.plant];
    if (plant.chosen != step.from || step.cost > room) continue;
    plant.chosen = step.to;
    room -= step.cost;
  }
}

}  // namespace

void describe(FieldVisitor& v, Budget& b) {
  v.number("frame_time", b.frame_time, "ms", {0.001, 1e6});
  v.integer("state_bytes", b.state_bytes, "B/s", {0, 100000000});
  v.integer("modal_trees", b.modal_trees, "", {0, 1000});
  v.number("procedural_cost", b.procedural_cost, "ns", {0.1, 10000.0});
  v.number("modal_cost", b.modal_cost, "ns", {0.1, 10000.0});
  v.number("physical_cost", b.physical_cost, "ns", {0.1, 1000000.0});
}

GovernorFigures govern(std::vector<Plant>& plants, double room, std::size_t modal,
                       double tolerance) {
  shareModes(plants, modal);
  GovernorFigures out;
  for (Plant& plant : plants) {
    plant.chosen = wantedOf(plant);
    out.wanted += costAt(plant, plant.chosen);
  }
  if (out.wanted > room) fit(plants, room);
  for (const Plant& plant : plants) {
    const double error = errorAt(plant, plant.chosen);
    out.cost += costAt(plant, plant.chosen);
    out.largest = std::max(out.largest, error);
    out.over += error > tolerance ? 1 : 0;
    out.held_back += plant.chosen < wantedOf(plant) ? 1 : 0;
    ++out.trees[static_cast<std::size_t>(plant.chosen)];
  }
  return out;
}

}  // namespace vegetation_sim::forest
