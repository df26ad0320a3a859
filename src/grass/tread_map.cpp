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
  per_spacing_ = 1.0 / spacing_;
}

std::size_t TreadMap::bytes() const {
  std::size_t sum = state_.blocks.size() * BLOCK_BYTES;
  for (const auto& entry : state_.sources) sum += entry.second.doses.size() * sizeof(double) + 128;
  return sum;
}

// Most strokes fall on the blocks of the ones before: a table in front of the tree.
const RecentBlock& TreadMap::blockAt(int row, int column, bool make) {
  RecentBlock& recent = recent_blocks_.at(row, column);
  if (!recent.is_known) {
    const auto found = state_.blocks.find({row, column});
    if (found != state_.blocks.end()) recent.set(found->second);
    recent.is_known = true;
  }
  if (recent.block || !make) return recent;
  const double size = static_cast<double>((state_.blocks.size() + 1) * BLOCK_BYTES);
  if (size <= settings_.memory_cap) recent.set(state_.blocks[{row, column}]);
  return recent;
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
  TreadStroke stroke(law, fullDose(law), from, stays ? source : before_, source);
  const int touched = press(stroke);
  ++(touched > 0 ? state_.counts.strokes : state_.counts.outside);
  return touched;
}

// The last one's, where many sources tread alike.
double TreadMap::fullDose(const TreadLaw& law) {
  if (law.radius != last_law_.radius || law.reach != last_law_.reach ||
      law.softness != last_law_.softness || !(last_full_ > 0.0)) {
    last_law_ = law;
    last_full_ = CompactField::ofEndlessTrack(law.radius, law.reach, law.softness);
  }
  return last_full_;
}

// Puts the window around the source. If it is another one than before, that is in `before_`.
bool TreadMap::moveWindow(TreadSource& source, double reach) {
  // One node more on each side, whatever rounding does.
  const int first_column = nodeBelow(source.position.x - reach, law_.origin_x, per_spacing_) - 1;
  const int first_row = nodeBelow(source.position.y - reach, law_.origin_y, per_spacing_) - 1;
  const int side = floorOf(2.0 * reach * per_spacing_) + 5;
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
  const auto column = [&](double x) { return nodeBelow(x, law_.origin_x, per_spacing_); };
  const auto row = [&](double y) { return nodeBelow(y, law_.origin_y, per_spacing_); };
  return {std::max(0, column(low.x - reach)),
          std::min((law_.columns - 1) * cells_, column(high.x + reach) + 1),
          std::max(0, row(low.y - reach)),
          std::min((law_.rows - 1) * cells_, row(high.y + reach) + 1)};
}

int TreadMap::press(TreadStroke& stroke) {
  const Box box = boxOf(stroke.low, stroke.high, stroke.law.reach);
  if (box.first_column > box.last_column || box.first_row > box.last_row) return 0;
  TreadNodes nodes;
  int touched = 0;
  for (int r = blockOf(box.first_row); r <= blockOf(box.last_row); ++r)
    for (int c = blockOf(box.first_column); c <= blockOf(box.last_column); ++c)
      touched += pressBlock(stroke, r, c, box, nodes);
  return touched + pressNodes(stroke, nodes);
}

// Collects the nodes of a block; presses when there are many.
int TreadMap::pressBlock(TreadStroke& stroke, int block_row, int block_column, const Box& box,
                         TreadNodes& nodes) {
  const TreadGrid grid{law_.origin_x, law_.origin_y, spacing_};
  const int row0 = block_row * SIDE, column0 = block_column * SIDE;
  const int last_row = std::min(box.last_row, row0 + SIDE - 1);
  const int first_column = std::max(box.first_column, column0);
  const int last_column = std::min(box.last_column, column0 + SIDE - 1);
  const TreadNode* there = blockAt(block_row, block_column, false).nodes;
  // Each source treads elsewhere: ask for its nodes at once, not one after the other.
  if (there)
    for (int r = std::max(box.first_row, row0); r <= last_row; ++r)
      for (int c = first_column; c <= last_column; c += 2)
        __builtin_prefetch(there + ((r - row0) * SIDE + c - column0), 1);
  int touched = 0;
  for (int r = std::max(box.first_row, row0); r <= last_row; ++r) {
    const double half = stroke.halfRow(grid.y(r));
    const int first =
        std::max(first_column, nodeBelow(stroke.low.x - half, law_.origin_x, per_spacing_));
    const int last =
        std::min(last_column, nodeBelow(stroke.high.x + half, law_.origin_x, per_spacing_));
    if (first > last) continue;
    if (nodes.count + SIDE > TreadNodes::MOST) touched += pressNodes(stroke, nodes);
    stroke.gather(grid, r, first, last, nodes);
  }
  return touched;
}

// Block by block, in the order in which they were collected. @return number of nodes within reach.
int TreadMap::pressNodes(TreadStroke& stroke, TreadNodes& nodes) {
  if (nodes.count == 0) return 0;
  measureNodes(stroke.line, nodes);
  stroke.keepDoses(nodes);
  // First who, then what: nothing foretells which nodes are pressed.
  int pressed[TreadNodes::MOST], count = 0, touched = 0;
  for (int i = 0; i < nodes.count; ++i) {
    const bool is_touched = stroke.isTouched(nodes, i);
    touched += is_touched;
    pressed[count] = i;
    count += is_touched && static_cast<float>(nodes.tilt[i]) >= CRUNCHED;
  }
  const RecentBlock* block = nullptr;
  for (int k = 0; k < count; ++k) {
    const int i = pressed[k], row = nodes.row[i], column = nodes.column[i];
    if (!block || !block->is(blockOf(row), blockOf(column)))
      block = &blockAt(blockOf(row), blockOf(column), true);
    if (!block->nodes) {
      ++state_.counts.no_memory;
      continue;
    }
    stroke.press(static_cast<float>(nodes.tilt[i]), {nodes.x[i], nodes.y[i]}, nodes.side[i],
                 block->nodes[row % SIDE * SIDE + column % SIDE]);
    block->block->until = std::max(block->block->until, stroke.latest);
  }
  nodes.count = 0;
  return touched;
}

}  // namespace vegetation_sim::grass
