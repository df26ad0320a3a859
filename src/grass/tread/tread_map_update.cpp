// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// What changes trodden ground other than treading on it.

#include <algorithm>
#include <limits>
#include <utility>

#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {
namespace {

constexpr int SIDE = TreadBlock::SIDE;

Nanoseconds uprightAt(const TreadNode& node) {
  if (double{node.recovery} >= PERMANENT_RECOVERY) return std::numeric_limits<Nanoseconds>::max();
  return node.stamp + fromSeconds(double{node.recovery});
}

}  // namespace

bool TreadMap::put(int row, int column, const TreadNode& node) {
  if (row < 0 || column < 0 || row > (law_.rows - 1) * cells_ ||
      column > (law_.columns - 1) * cells_)
    return false;
  TreadBlock* const block = blockAt(row / SIDE, column / SIDE, true);
  if (!block) return false;
  block->nodes[static_cast<std::size_t>(row % SIDE * SIDE + column % SIDE)] = node;
  block->until = std::max(block->until, uprightAt(node));
  return true;
}

void TreadMap::raise(const Point& place, double radius) {
  const double square = radius * radius;
  for (auto& [key, block] : state_.blocks)
    for (int i = 0; i < SIDE * SIDE; ++i) {
      const int column = key.second * SIDE + i % SIDE, row = key.first * SIDE + i / SIDE;
      const double x = law_.origin_x + column * spacing_ - place.x;
      const double y = law_.origin_y + row * spacing_ - place.y;
      if (x * x + y * y <= square) block.nodes[static_cast<std::size_t>(i)] = TreadNode();
    }
}

}  // namespace vegetation_sim::grass
