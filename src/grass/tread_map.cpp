// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vegetation_sim/common/math.h"

namespace vegetation_sim::grass {
namespace {

constexpr int SIDE = TreadBlock::SIDE;
constexpr int MAX_CELLS = 512;  // along a tile
constexpr Nanoseconds FOR_EVER = std::numeric_limits<Nanoseconds>::max();
constexpr std::size_t BLOCK_BYTES = sizeof(TreadBlock) + sizeof(TreadNode) * SIDE * SIDE + 64;

int blockOf(int node) {
  return node >> 4;  // rounds down
}
static_assert(SIDE == 16, "blockOf");

Nanoseconds recoveredAt(Nanoseconds stamp, double recovery) {
  return recovery >= PERMANENT_RECOVERY ? FOR_EVER : stamp + fromSeconds(recovery);
}

bool isFinite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

int floorOf(double x) {
  return static_cast<int>(std::floor(std::min(1e9, std::max(-1e9, x))));
}

}  // namespace

void describe(FieldVisitor& v, TreadSettings& s) {
  v.number("spacing", s.spacing, "m", {0.01, 10.0});
  v.number("memory_cap", s.memory_cap, "bytes", {1e5, 1e11});
  v.number("longest_stroke", s.longest_stroke, "m", {0.01, 100.0});
  v.number("top_speed", s.top_speed, "m/s", {0.1, 1000.0});
}

/// Nodes from first to last, both included.
struct TreadMap::Box {
  int first_column, last_column, first_row, last_row;
};

namespace {

double doseAt(const TreadSource& source, int row, int column) {
  const int r = row - source.first_row, c = column - source.first_column;
  if (r < 0 || c < 0 || r >= source.rows || c >= source.columns) return 0.0;
  return source.doses[static_cast<std::size_t>(r) * source.columns + c];
}

float tiltNow(const TreadNode& node, Nanoseconds stamp) {
  if (!(node.tilt > 0.f) || stamp < node.stamp || !(node.recovery > 0.f)) return 0.f;
  if (node.recovery >= static_cast<float>(PERMANENT_RECOVERY)) return node.tilt;
  const double part = secondsBetween(node.stamp, stamp) / double{node.recovery};
  return static_cast<float>(double{node.tilt} * (1.0 - smoothStep(part)));
}

}  // namespace

/// One segment being pressed: old doses in, new ones out. Its functions are in the class so that
/// the loop over the nodes is one piece of code.
struct TreadMap::Stroke {
  Stroke(const TreadLaw& l, const Point& from, const TreadSource& old, TreadSource& fresh)
      : law(l),
        field(from, fresh.position, l.reach, l.softness),
        full(CompactField::ofEndlessTrack(l.radius, l.reach, l.softness)),
        per_full(1.0 / full),
        enough(full / std::max(l.load, 1e-9)),
        square_reach(l.reach * l.reach),
        latest(recoveredAt(fresh.stamp, static_cast<float>(l.recovery))),
        before(old),
        after(fresh) {
    const bool moves = field.length() > 0.0;
    after.has_moved = moves || before.has_moved;
    after.along = moves ? field.along() : before.along;
  }

  double addDose(int row, int column, const Point& p, const CompactField::Place& place) {
    double dose = doseAt(before, row, column);
    if (dose < enough) dose += field.fieldAt(place);  // no dose crushes more than fully
    const double dx = p.x - after.position.x, dy = p.y - after.position.y;
    // What the source leaves behind begins a new pass when it comes back.
    if (dx * dx + dy * dy < square_reach)
      after.doses[static_cast<std::size_t>(row - after.first_row) * after.columns + column -
                  after.first_column] = dose;
    return dose;
  }

  // Of the dose within this pass, or of the print of the foot, which crushes even where it stands.
  float tiltOf(double dose, double square_distance) const {
    double part = dose * per_full;
    if (dose < enough && square_distance < 2.25 * law.radius * law.radius) {
      const double outside = std::sqrt(square_distance) - law.radius;
      part = std::max(part, 1.0 - smoothStep(outside / (0.5 * law.radius)));
    }
    return static_cast<float>(BEND_LIMIT * std::min(1.0, law.load * part));
  }

  // True if the node was pressed so lately, and no more than now, that it is surely still down.
  bool isFresh(const TreadNode& node, float tilt) const {
    const Nanoseconds age = after.stamp - node.stamp;
    return node.tilt > 2.f * CRUNCHED && node.tilt <= tilt && age >= 0 &&
           static_cast<double>(age) * 1e-9 < 0.1 * double{node.recovery};
  }

  // Against what is there the larger tilt counts (E15); only a node that had risen takes a new
  // direction (S2-27).
  void press(float tilt, const Point& p, double side, TreadNode& node) {
    const float now = isFresh(node, tilt) ? tilt : tiltNow(node, after.stamp);
    if (now <= CRUNCHED) turn(p, side, node);
    if (tilt >= now)
      node.recovery = static_cast<float>(law.recovery);
    else
      latest = std::max(latest, recoveredAt(after.stamp, double{node.recovery}));
    node.tilt = std::max(now, tilt);
    node.stamp = after.stamp;
  }

  // sign(A.N) N + C, or outward under a foot that came straight down.
  void turn(const Point& p, double side, TreadNode& node) const {
    double x = p.x - after.position.x, y = p.y - after.position.y;
    if (after.has_moved) {
      const double sign = side > NO_SIDE ? 1.0 : side < -NO_SIDE ? -1.0 : 0.0;
      x = after.along.x - sign * after.along.y;
      y = after.along.y + sign * after.along.x;
    }
    const double size = std::sqrt(x * x + y * y);
    node.x = size > NO_SIDE ? static_cast<float>(x / size) : 1.f;
    node.y = size > NO_SIDE ? static_cast<float>(y / size) : 0.f;
  }

  const TreadLaw& law;
  CompactField field;
  double full;      ///< dose that crushes fully
  double per_full;  ///< its inverse
  double enough;    ///< likewise, of this load
  double square_reach;
  Nanoseconds latest;  ///< when the last of the pressed nodes has recovered
  const TreadSource& before;
  TreadSource& after;
};

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
TreadBlock* TreadMap::blockAt(int row, int column, bool make) {
  TreadBlock*& known = recent_.at(row, column);
  if (known) return known;
  const auto found = state_.blocks.find({row, column});
  if (found != state_.blocks.end()) return known = &found->second;
  const double size = static_cast<double>((state_.blocks.size() + 1) * BLOCK_BYTES);
  if (!make || size > settings_.memory_cap) return nullptr;
  return known = &state_.blocks[{row, column}];
}

bool TreadMap::isJump(const TreadSource& from, const Point& to, Nanoseconds stamp) const {
  const double x = to.x - from.position.x, y = to.y - from.position.y;
  const double way = std::sqrt(x * x + y * y), seconds = secondsBetween(from.stamp, stamp);
  return way > settings_.longest_stroke || (seconds > 0.0 && way > settings_.top_speed * seconds);
}

int TreadMap::tread(std::uint32_t id, const TreadLaw& law, const Point& position,
                    Nanoseconds stamp) {
  const auto found = state_.sources.find(id);
  const bool known = found != state_.sources.end();
  if (!isFinite(position) || (known && stamp < found->second.stamp)) {
    ++state_.counts.invalid;
    return 0;
  }
  TreadSource& after = known ? found->second : state_.sources[id];
  Point from = known ? after.position : position;
  std::swap(before_, after);  // and reuses its memory
  if (!known || isJump(before_, position, stamp)) {
    if (known) ++state_.counts.jumps;
    from = position;
    before_.columns = before_.rows = 0;
    before_.has_moved = false;
    before_.along = Point();
  }
  after.position = position;
  after.stamp = stamp;
  Stroke stroke(law, from, before_, after);
  const int touched = press(stroke, from);
  ++(touched > 0 ? state_.counts.strokes : state_.counts.outside);
  return touched;
}

int TreadMap::press(Stroke& stroke, const Point& from) {
  const double reach = stroke.law.reach;
  TreadSource& window = stroke.after;
  const Point& to = window.position;
  const auto column = [&](double x) { return floorOf((x - law_.origin_x) / spacing_); };
  const auto row = [&](double y) { return floorOf((y - law_.origin_y) / spacing_); };
  // One node more on each side, whatever rounding does.
  window.first_column = column(to.x - reach) - 1;
  window.first_row = row(to.y - reach) - 1;
  window.columns = window.rows = floorOf(2.0 * reach / spacing_) + 5;
  window.doses.assign(static_cast<std::size_t>(window.columns) * window.rows, 0.0);
  const Box box{std::max(0, column(std::min(from.x, to.x) - reach)),
                std::min((law_.columns - 1) * cells_, column(std::max(from.x, to.x) + reach) + 1),
                std::max(0, row(std::min(from.y, to.y) - reach)),
                std::min((law_.rows - 1) * cells_, row(std::max(from.y, to.y) + reach) + 1)};
  int touched = 0;
  if (box.first_column > box.last_column || box.first_row > box.last_row) return touched;
  for (int r = blockOf(box.first_row); r <= blockOf(box.last_row); ++r)
    for (int c = blockOf(box.first_column); c <= blockOf(box.last_column); ++c)
      touched += pressBlock(stroke, r, c, box);
  return touched;
}

int TreadMap::pressBlock(Stroke& stroke, int block_row, int block_column, const Box& box) {
  TreadBlock* block = blockAt(block_row, block_column, false);
  bool full = false;
  int touched = 0;
  const int row0 = block_row * SIDE, column0 = block_column * SIDE;
  const int last_row = std::min(box.last_row, row0 + SIDE - 1);
  const int last_column = std::min(box.last_column, column0 + SIDE - 1);
  const int first_column = std::max(box.first_column, column0);
  // Each source treads elsewhere: ask for its nodes at once, not one after the other.
  if (block)
    for (int row = std::max(box.first_row, row0); row <= last_row; ++row)
      for (int column = first_column; column <= last_column; column += 2)
        __builtin_prefetch(
            &block->nodes[static_cast<std::size_t>((row - row0) * SIDE + column - column0)]);
  for (int row = std::max(box.first_row, row0); row <= last_row; ++row)
    for (int column = first_column; column <= last_column; ++column) {
      const Point p{law_.origin_x + column * spacing_, law_.origin_y + row * spacing_};
      const CompactField::Place place = stroke.field.placeOf(p);
      if (place.square_distance >= stroke.square_reach) continue;
      ++touched;
      const double dose = stroke.addDose(row, column, p, place);
      const float tilt = stroke.tiltOf(dose, place.square_distance);
      if (tilt < CRUNCHED) continue;
      if (!block && !full) {
        block = blockAt(block_row, block_column, true);
        full = !block;
      }
      if (full)
        ++state_.counts.no_memory;
      else
        stroke.press(
            tilt, p, place.side,
            block->nodes[static_cast<std::size_t>((row - row0) * SIDE + column - column0)]);
    }
  if (block) block->until = std::max(block->until, stroke.latest);
  return touched;
}

float tiltAt(const TreadNode& node, Nanoseconds stamp) {
  return tiltNow(node, stamp);
}

}  // namespace vegetation_sim::grass
