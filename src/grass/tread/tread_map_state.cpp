// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Queries, changes and hashes of the state; tread_map.cpp presses the strokes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "grass/map/tile_owners.h"
#include "grass/tread/tile_nodes.h"
#include "grass/tread/tread_recovery.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/grass/tread/tread_map.h"

namespace vegetation_sim::grass {
namespace {

Nanoseconds uprightAt(const TreadNode& node) {
  if (double{node.recovery} >= PERMANENT_RECOVERY) return std::numeric_limits<Nanoseconds>::max();
  return node.stamp + fromSeconds(double{node.recovery});
}

}  // namespace

TreadNode TreadMap::at(const Point& place, Nanoseconds stamp) const {
  const double u = std::floor((place.x - law_.origin_x) / spacing_ + 0.5);
  const double v = std::floor((place.y - law_.origin_y) / spacing_ + 0.5);
  const double columns = (law_.columns - 1.0) * cells_, rows = (law_.rows - 1.0) * cells_;
  if (!(u >= 0.0 && v >= 0.0 && u <= columns && v <= rows)) return {};
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const auto found = state_.blocks.find({row / SIDE, column / SIDE});
  if (found == state_.blocks.end()) return {};
  TreadNode node = found->second.nodes[static_cast<std::size_t>(row % SIDE * SIDE + column % SIDE)];
  node.tilt = tiltAt(node, stamp);
  return node.tilt > 0.f ? node : TreadNode();
}

void TreadMap::patch(int tile_column, int tile_row, Nanoseconds stamp, CrushPatch& out) const {
  out.cells = 0;
  const auto side = static_cast<std::size_t>(cells_ + 1);
  visitTileNodes(
      state_.blocks, tile_column, tile_row, cells_,
      [&](const TreadBlock& block) {
        if (block.until <= stamp) return false;
        if (out.cells > 0) return true;
        out.cells = cells_;
        for (std::vector<float>* layer : {&out.tilt, &out.tx, &out.ty})
          layer->assign(side * side, 0.f);
        return true;
      },
      [&](const TreadNode& node, std::size_t to) {
        out.tilt[to] = tiltAt(node, stamp);
        out.tx[to] = out.tilt[to] * node.x;
        out.ty[to] = out.tilt[to] * node.y;
      });
  cuts_.patch(tile_column, tile_row, out);
}

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

void TreadMap::prune(Nanoseconds stamp) {
  const std::size_t before = state_.blocks.size();
  for (auto entry = state_.blocks.begin(); entry != state_.blocks.end();)
    entry = entry->second.until <= stamp ? state_.blocks.erase(entry) : std::next(entry);
  if (state_.blocks.size() < before) forgetRecent();
}

void TreadMap::clear() {
  restore(TreadState());
  cuts_.restore(CutState());
}

void TreadMap::clearShard(const TileOwners& owners, std::uint32_t shard) {
  const auto belongs = [&](int row, int column) {
    return owners.ownerOfBlock(row, column, cells_) == shard;
  };
  for (auto entry = state_.blocks.begin(); entry != state_.blocks.end();)
    entry = belongs(entry->first.first, entry->first.second) ? state_.blocks.erase(entry)
                                                             : std::next(entry);
  cuts_.clear(belongs);
  forgetRecent();
}

void TreadMap::restore(TreadState state) {
  forgetRecent();
  state_ = std::move(state);
  doses_count_ = 0;
  for (const auto& entry : state_.sources) doses_count_ += entry.second.doses.size();
}

std::uint64_t TreadState::hash() const {
  Hash hash;
  const auto add = [&](auto value) { hash.add(static_cast<std::uint64_t>(value)); };
  for (const auto& entry : blocks) {
    add(entry.first.first);
    add(entry.first.second);
    add(entry.second.until);
    for (const TreadNode& node : entry.second.nodes) {
      for (const float value : {node.tilt, node.x, node.y, node.recovery}) hash.add(double{value});
      add(node.stamp);
    }
  }
  for (const auto& entry : sources) {
    const TreadSource& s = entry.second;
    add(entry.first);
    for (const double value : {s.position.x, s.position.y, s.along.x, s.along.y}) hash.add(value);
    add(s.has_moved);
    add(s.stamp);
    for (const int value : {s.first_column, s.first_row, s.columns, s.rows}) add(value);
    for (const double dose : s.doses) hash.add(dose);
  }
  for (const std::uint64_t count :
       {counts.strokes, counts.invalid, counts.jumps, counts.outside, counts.no_memory})
    add(count);
  return hash.value();
}

}  // namespace vegetation_sim::grass
