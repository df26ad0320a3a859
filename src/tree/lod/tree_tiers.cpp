// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/lod/tree_tiers.h"

#include <algorithm>

#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {
namespace {

// Bytes of a modal tree in a key frame, by its amplitudes and rates; key frames come once a second
// [B/s].
int bytesOf(int tier) {
  constexpr int HEAD = 48;
  const ModalDepth depth = tier == FINE_MODAL_TIER ? FINE_MODES : ModalDepth{};
  return HEAD + static_cast<int>(2 * sizeof(double) * depth.most());
}

}  // namespace

void describe(FieldVisitor& v, Budget& b) {
  v.number("frame_time", b.frame_time, "ms", {0.001, 1e6});
  v.integer("state_bytes", b.state_bytes, "B/s", {0, 100000000});
  v.integer("modal_trees", b.modal_trees, "", {0, 1000});
  v.number("tree_cost", b.tree_cost, "ns", {0.0, 1000000.0});
  v.number("procedural_cost", b.procedural_cost, "ns", {0.1, 10000.0});
  v.number("modal_cost", b.modal_cost, "ns", {0.1, 10000.0});
  v.number("fine_cost", b.fine_cost, "ns", {0.1, 10000.0});
  v.number("physical_cost", b.physical_cost, "ns", {0.1, 1000000.0});
}

void shareModes(std::vector<Plant>& plants, int trees, int bytes) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const Plant& plant = plants[i];
    if (plant.wanted < MODAL_LEVEL) continue;
    const double held = plant.held >= MODAL_LEVEL ? STICKY : 1.0;
    order.emplace_back(-held * plant.error[static_cast<std::size_t>(plant.stepwise)], i);
  }
  std::sort(order.begin(), order.end());
  std::vector<Plant*> finer;
  for (const auto& [priority, index] : order) {
    Plant& plant = plants[index];
    const int least = std::clamp(plant.above, MODAL_LEVEL, plant.wanted);
    if (trees <= 0 || bytesOf(least) > bytes) {
      plant.wanted = plant.stepwise;
      continue;
    }
    --trees;
    bytes -= bytesOf(least);
    if (plant.wanted > least) finer.push_back(&plant);
    plant.wanted = least;
  }
  const int more = bytesOf(FINE_MODAL_TIER) - bytesOf(MODAL_LEVEL);
  for (Plant* plant : finer) {
    if (more > bytes) break;
    bytes -= more;
    plant->wanted = FINE_MODAL_TIER;
  }
}

}  // namespace vegetation_sim::forest
