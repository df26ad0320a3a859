// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grass/tread_stroke.h"
#include "vegetation_sim/common/math.h"

namespace vegetation_sim::grass {
namespace {

constexpr int SIDE = TreadBlock::SIDE;
constexpr int MAX_CELLS = 512;  // along a tile
constexpr std::size_t BLOCK_BYTES = sizeof(TreadBlock) + sizeof(TreadNode) * SIDE * SIDE + 64;

int blockOf(int node) {
  return node >> 4;  // rounds down
}
static_assert(SIDE == 16, "blockOf");

bool isFinite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace

void describe(FieldVisitor& v, TreadSettings& s) {
  v.number("spacing", s.spacing, "m", {0.01, 10.0});
  v.number("memory_cap", s.memory_cap, "bytes", {1e5, 1e11});
  v.number("longest_stroke", s.longest_stroke, "m", {0.01, 100.0});
  v.number("top_speed", s.top_speed, "m/s", {0.1, 1000.0});
}

TreadMap::TreadMap(const MapLaw& law, const TreadSettings& settings)
    : law_(law), settings_(settings) {
  Faults faults;
  FieldChecker checker("treading: ", faults);
  describe(checker, settings_);
  faults.throwIfAny();
  const double cells = std::floor(law.resolution / settings.spacing + 0.5);
  if (cells > MAX_CELLS)
    faults.add("treading: spacing = " + std::to_string(settings.spacing) + " m makes " +
               std::to_string(static_cast<int>(cells)) + " cells along a tile of " +
               std::to_string(law.resolution) + " m, allowed are " + std::to_string(MAX_CELLS));
  faults.throwIfAny();
  cells_ = std::max(1, static_cast<int>(cells));
  spacing_ = law.resolution / cells_;
}

std::size_t TreadMap::bytes() const {
  std::size_t sum = state_.blocks.size() * BLOCK_BYTES;
  for (const auto& entry : state_.sources) sum += entry.second.doses.size() * sizeof(double) + 128;
  return sum;
}

// Most strokes fall on the blocks of the ones before: a table in front of the tree.
RecentBlock TreadMap::blockAt(int row, int column, bool make) {
  RecentBlock& known = recent_blocks_.at(row, column);
  if (known.block) return known;
  const auto found = state_.blocks.find({row, column});
  TreadBlock* block = found != state_.blocks.end() ? &found->second : nullptr;
  const double size = static_cast<double>((state_.blocks.size() + 1) * BLOCK_BYTES);
  if (!block && make && size <= settings_.memory_cap) block = &state_.blocks[{row, column}];
  known.block = block;
  known.nodes = block ? block->nodes.data() : nullptr;
  return known;
}

// Null if it is not on the ground.
TreadSource* TreadMap::sourceOf(std::uint32_t id) {
  RecentSource& known = recent_sources_.at(id);
  if (known.source) return known.source;
  const auto found = state_.sources.find(id);
  return known.source = found != state_.sources.end() ? &found->second : nullptr;
}

void TreadMap::lift(std::uint32_t source) {
  recent_sources_.at(source).source = nullptr;
  state_.sources.erase(source);
}

void TreadMap::forgetRecent() {
  recent_blocks_.clear();
  recent_sources_.clear();
}

bool TreadMap::isJump(const TreadSource& from, const Point& to, Nanoseconds stamp) const {
  const double x = to.x - from.position.x, y = to.y - from.position.y;
  const double way = std::sqrt(x * x + y * y), seconds = secondsBetween(from.stamp, stamp);
  return way > settings_.longest_stroke || (seconds > 0.0 && way > settings_.top_speed * seconds);
}

int TreadMap::tread(std::uint32_t id, const TreadLaw& law, const Point& position,
                    Nanoseconds stamp) {
  TreadSource* known = sourceOf(id);
  if (!isFinite(position) || (known && stamp < known->stamp)) {
    ++state_.counts.invalid;
    return 0;
  }
  TreadSource& source = known ? *known : state_.sources[id];
  Point from = source.position;
  if (!known || isJump(source, position, stamp)) {
    if (known) ++state_.counts.jumps;
    from = position;
    source.columns = source.rows = 0;
    source.has_moved = false;
    source.along = Point();
  }
  source.position = position;
  source.stamp = stamp;
  const bool stays = !moveWindow(source, law.reach);
  TreadStroke stroke(law, from, stays ? source : before_, source);
  const int touched = press(stroke);
  ++(touched > 0 ? state_.counts.strokes : state_.counts.outside);
  return touched;
}

// Puts the window around the source. If it is another one than before, that is in `before_`.
bool TreadMap::moveWindow(TreadSource& source, double reach) {
  // One node more on each side, whatever rounding does.
  const int first_column = nodeBelow(source.position.x - reach, law_.origin_x, spacing_) - 1;
  const int first_row = nodeBelow(source.position.y - reach, law_.origin_y, spacing_) - 1;
  const int side = floorOf(2.0 * reach / spacing_) + 5;
  if (source.first_column == first_column && source.first_row == first_row &&
      source.columns == side && source.rows == side)
    return false;
  before_.along = source.along;
  before_.has_moved = source.has_moved;
  before_.first_column = std::exchange(source.first_column, first_column);
  before_.first_row = std::exchange(source.first_row, first_row);
  before_.columns = std::exchange(source.columns, side);
  before_.rows = std::exchange(source.rows, side);
  before_.doses.swap(source.doses);
  source.doses.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0);
  return true;
}

TreadMap::Box TreadMap::boxOf(const Point& low, const Point& high, double reach) const {
  const auto column = [&](double x) { return nodeBelow(x, law_.origin_x, spacing_); };
  const auto row = [&](double y) { return nodeBelow(y, law_.origin_y, spacing_); };
  return {std::max(0, column(low.x - reach)),
          std::min((law_.columns - 1) * cells_, column(high.x + reach) + 1),
          std::max(0, row(low.y - reach)),
          std::min((law_.rows - 1) * cells_, row(high.y + reach) + 1)};
}

int TreadMap::press(TreadStroke& stroke) {
  const Box box = boxOf(stroke.low, stroke.high, stroke.law.reach);
  int touched = 0;
  if (box.first_column > box.last_column || box.first_row > box.last_row) return touched;
  for (int r = blockOf(box.first_row); r <= blockOf(box.last_row); ++r)
    for (int c = blockOf(box.first_column); c <= blockOf(box.last_column); ++c)
      touched += pressBlock(stroke, r, c, box);
  return touched;
}

int TreadMap::pressBlock(TreadStroke& stroke, int block_row, int block_column, const Box& box) {
  const TreadGrid grid{law_.origin_x, law_.origin_y, spacing_};
  const int row0 = block_row * SIDE, column0 = block_column * SIDE;
  const int first_row = std::max(box.first_row, row0);
  const int last_row = std::min(box.last_row, row0 + SIDE - 1);
  const int first_column = std::max(box.first_column, column0);
  const int last_column = std::min(box.last_column, column0 + SIDE - 1);
  RecentBlock block = blockAt(block_row, block_column, false);
  const auto node_at = [&](int row, int column) {
    return block.nodes + static_cast<std::ptrdiff_t>((row - row0) * SIDE + column - column0);
  };
  // Each source treads elsewhere: ask for its nodes at once, not one after the other.
  if (block.nodes)
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; column += 2)
        __builtin_prefetch(node_at(row, column), 1);
  bool full = false;
  int touched = 0;
  for (int r = first_row; r <= last_row; ++r) {
    TreadRow row;
    row.row = r;
    row.first = first_column;
    row.last = last_column;
    stroke.cut(row, grid);
    if (row.first > row.last) continue;
    touched += stroke.measure(row, grid);
    for (int column = row.first; column <= row.last; ++column) {
      const int i = column - row.first;
      const auto tilt = static_cast<float>(row.tilt[i]);
      if (tilt < CRUNCHED || !stroke.isTouched(row, i)) continue;
      if (!block.nodes && !full) {
        block = blockAt(block_row, block_column, true);
        full = !block.nodes;
      }
      if (full)
        ++state_.counts.no_memory;
      else
        stroke.press(tilt, {grid.x(column), grid.y(r)}, row.side[i], *node_at(r, column));
    }
  }
  if (block.block) block.block->until = std::max(block.block->until, stroke.latest);
  return touched;
}

float tiltAt(const TreadNode& node, Nanoseconds stamp) {
  if (!(node.tilt > 0.f) || stamp < node.stamp || !(node.recovery > 0.f)) return 0.f;
  if (node.recovery >= static_cast<float>(PERMANENT_RECOVERY)) return node.tilt;
  const double part = secondsBetween(node.stamp, stamp) / double{node.recovery};
  return static_cast<float>(double{node.tilt} * (1.0 - smoothStep(part)));
}

}  // namespace vegetation_sim::grass
