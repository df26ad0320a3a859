// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/governor.h"

#include <algorithm>

namespace vegetation_sim::forest {

void describe(FieldVisitor& v, Budget& b) {
  v.number("frame_time", b.frame_time, "ms", {0.001, 1e6});
  v.integer("state_bytes", b.state_bytes, "B/s", {0, 100000000});
  v.integer("modal_trees", b.modal_trees, "", {0, 1000});
  v.number("procedural_cost", b.procedural_cost, "ns", {0.1, 10000.0});
  v.number("modal_cost", b.modal_cost, "ns", {0.1, 10000.0});
  v.number("physical_cost", b.physical_cost, "ns", {0.1, 1000000.0});
}

void shareModes(std::vector<Plant>& plants, std::size_t room) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const Plant& plant = plants[i];
    if (plant.wanted != MODAL_LEVEL) continue;
    const double held = plant.held == MODAL_LEVEL ? STICKY : 1.0;
    order.emplace_back(-held * plant.error[static_cast<std::size_t>(plant.stair)], i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t k = room; k < order.size(); ++k) {
    Plant& plant = plants[order[k].second];
    plant.wanted = plant.stair;
  }
}

}  // namespace vegetation_sim::forest
