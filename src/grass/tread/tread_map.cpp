// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/tread/tread_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "grass/map/tile_owners.h"
#include "grass/tread/tread_press.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {
namespace {

constexpr int MAX_CELLS = 512;  // fine cells along a tile
constexpr std::size_t BLOCK_BYTES = sizeof(TreadBlock) + 64;
constexpr std::size_t SOURCE_BYTES = sizeof(TreadSource) + 64;

int blockOf(int node) {
  return node >> 4;  // rounds down
}
static_assert(TreadBlock::SIDE == 16, "blockOf");

int wholeVectors(int nodes) {
  return (nodes + TreadBand::PITCH - 1) / TreadBand::PITCH * TreadBand::PITCH;
}

// Visits the doses of nodes that are both in the window of a source and in a band.
template <class Visit>
void exchangeDoses(TreadSource& source, const TreadBand& band, const Visit& visit) {
  const int first = std::max(source.first_column, band.first_column);
  const int last = std::min(source.first_column + source.columns, band.first_column + band.pitch);
  const int first_row = std::max(source.first_row, band.first_row);
  const int last_row = std::min(source.first_row + source.rows, band.first_row + band.rows);
  for (int row = first_row; row < last_row; ++row) {
    double* const in_window = source.doses.data() + (row - source.first_row) * source.columns;
    double* const in_band = band.doses + (row - band.first_row) * band.pitch;
    for (int column = first; column < last; ++column)
      visit(in_window[column - source.first_column], in_band[column - band.first_column]);
  }
}

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

TreadMap::TreadMap(const MapLaw& law, const TreadSettings& settings,
                   std::shared_ptr<const TileOwners> owners)
    : law_(law),
      settings_(settings),
      owners_(owners ? std::move(owners) : std::make_shared<const TileOwners>()) {
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
  cuts_ = CutMap(law, cells_, settings.memory_cap);
}

std::size_t TreadMap::bytes() const {
  return state_.blocks.size() * BLOCK_BYTES + state_.sources.size() * SOURCE_BYTES +
         doses_count_ * sizeof(double);
}

bool TreadMap::hasRoom(std::size_t more) const {
  return static_cast<double>(bytes() + more) <= settings_.memory_cap;
}

// Looks up a block in a table first, since most strokes press the blocks of the ones before.
// Returns null if it does not exist and is not wanted, or finds no memory.
TreadBlock* TreadMap::blockAt(int row, int column, bool make) {
  RecentBlock& recent = recent_blocks_.at(row, column);
  if (!recent.is_known) {
    const auto found = state_.blocks.find({row, column});
    if (found != state_.blocks.end()) recent.block = &found->second;
    recent.is_known = true;
  }
  if (recent.block || !make) return recent.block;
  if (hasRoom(BLOCK_BYTES)) recent.block = &state_.blocks[{row, column}];
  return recent.block;
}

// Returns null if the source is not on the ground.
TreadSource* TreadMap::sourceOf(std::uint32_t id) {
  RecentSource& known = recent_sources_.at(id);
  if (known.source) return known.source;
  const auto found = state_.sources.find(id);
  return known.source = found != state_.sources.end() ? &found->second : nullptr;
}

void TreadMap::lift(std::uint32_t source) {
  recent_sources_.at(source).source = nullptr;
  const auto found = state_.sources.find(source);
  if (found == state_.sources.end()) return;
  doses_count_ -= found->second.doses.size();
  state_.sources.erase(found);
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
  TreadStroke stroke(law, fullDose(law), from, source);
  if (owners_->shard().count > 1 &&
      !ownsAnyOf(boxOf(stroke.line.low, stroke.line.high, law.reach))) {
    dropWindow(source);
    ++state_.counts.outside;
    return 0;
  }
  const bool moved = moveWindow(source, law.reach);
  if (source.doses.empty()) {
    ++state_.counts.no_memory;
    return 0;
  }
  const int touched = moved ? pressBands(stroke) : pressWindow(stroke);
  ++(touched > 0 ? state_.counts.strokes : state_.counts.outside);
  return touched;
}

// Caches the result, since many sources have the same law.
double TreadMap::fullDose(const TreadLaw& law) {
  if (law.radius != last_law_.radius || law.reach != last_law_.reach ||
      law.softness != last_law_.softness || !(last_full_ > 0.0)) {
    last_law_ = law;
    last_full_ = CompactField::ofEndlessTrack(law.radius, law.reach, law.softness);
  }
  return last_full_;
}

// Puts the window around the source. If it has moved, the last one is in `before_`. A source that
// finds no memory has no window.
bool TreadMap::moveWindow(TreadSource& source, double reach) {
  const int first_column = nodeBelow(source.position.x - reach, law_.origin_x, per_spacing_);
  const int first_row = nodeBelow(source.position.y - reach, law_.origin_y, per_spacing_);
  const int rows = floorOf(2.0 * reach * per_spacing_) + 3;  // one row more, for rounding
  const int columns = wholeVectors(rows);
  if (source.first_column == first_column && source.first_row == first_row &&
      source.columns == columns && source.rows == rows)
    return false;
  before_.first_column = std::exchange(source.first_column, first_column);
  before_.first_row = std::exchange(source.first_row, first_row);
  before_.columns = std::exchange(source.columns, columns);
  before_.rows = std::exchange(source.rows, rows);
  before_.doses.swap(source.doses);
  doses_count_ -= before_.doses.size();
  resizeDoses(source, static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  doses_count_ += source.doses.size();
  return true;
}

// A buffer that is much too large would be memory that is not counted.
void TreadMap::resizeDoses(TreadSource& source, std::size_t count) {
  if (source.doses.capacity() > 2 * count) source.doses = {};
  if (hasRoom(count * sizeof(double)))
    source.doses.assign(count, 0.0);
  else
    source.doses = {};
  if (source.doses.empty()) source.columns = source.rows = 0;
}

TreadGrid TreadMap::grid() const {
  return {
      law_.origin_x,           law_.origin_y, spacing_, per_spacing_, (law_.columns - 1) * cells_,
      (law_.rows - 1) * cells_};
}

TreadMap::Box TreadMap::boxOf(const Point& low, const Point& high, double reach) const {
  const auto column = [&](double x) { return nodeBelow(x, law_.origin_x, per_spacing_); };
  const auto row = [&](double y) { return nodeBelow(y, law_.origin_y, per_spacing_); };
  return {std::max(0, column(low.x - reach)),
          std::min((law_.columns - 1) * cells_, column(high.x + reach) + 1),
          std::max(0, row(low.y - reach)),
          std::min((law_.rows - 1) * cells_, row(high.y + reach) + 1)};
}

// Presses a short step, which stays within the window.
int TreadMap::pressWindow(TreadStroke& stroke) {
  TreadSource& s = stroke.after;
  const int first = std::max(0, s.first_row);
  const int last = std::min((law_.rows - 1) * cells_, s.first_row + s.rows - 1);
  if (first > last) return 0;
  return pressBand(stroke, {s.first_column, first, last - first + 1, s.columns,
                            s.doses.data() + (first - s.first_row) * s.columns});
}

// Presses a longer step, some rows at a time: doses are copied from the old window to the new one.
// Doses outside of the new window are lost, so a source that comes back begins a new pass.
int TreadMap::pressBands(TreadStroke& stroke) {
  constexpr int WANTED = 1024;  // wanted nodes of a band
  const Box box = boxOf(stroke.line.low, stroke.line.high, stroke.law.reach);
  if (box.first_column > box.last_column || box.first_row > box.last_row) return 0;
  const int pitch = wholeVectors(box.last_column - box.first_column + 1);
  const int most = std::max(1, WANTED / pitch);
  int touched = 0;
  for (int row = box.first_row; row <= box.last_row; row += most) {
    const int rows = std::min(most, box.last_row - row + 1);
    doses_.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(pitch), 0.0);
    const TreadBand band{box.first_column, row, rows, pitch, doses_.data()};
    exchangeDoses(before_, band, [](double in_window, double& in_band) { in_band = in_window; });
    touched += pressBand(stroke, band);
    exchangeDoses(stroke.after, band,
                  [](double& in_window, double in_band) { in_window = in_band; });
  }
  return touched;
}

// Whether the shard has a block in a box of nodes. Doses of other nodes are not needed.
bool TreadMap::ownsAnyOf(const Box& box) const {
  for (int row = blockOf(box.first_row); row <= blockOf(box.last_row); ++row)
    for (int column = blockOf(box.first_column); column <= blockOf(box.last_column); ++column)
      if (owners_->ownsBlock(row, column, cells_)) return true;
  return false;
}

// A source that has pressed no node of the shard has no dose there.
void TreadMap::dropWindow(TreadSource& source) {
  doses_count_ -= source.doses.size();
  source.doses = {};
  source.first_column = source.first_row = source.columns = source.rows = 0;
}

// @return number of nodes within reach.
int TreadMap::pressBand(TreadStroke& stroke, const TreadBand& band) {
  const Box box{std::max(0, band.first_column), band.first_column + band.pitch - 1,
                std::max(0, band.first_row), band.first_row + band.rows - 1};
  if (owners_->shard().count > 1 && !ownsAnyOf(box)) return 0;
  prefetch(band);
  const TreadGrid grid = this->grid();
  measureBand(stroke.line, grid, band, presses_);
  constexpr std::uint64_t ITS_BLOCK = ~0xF0000000Full;
  for (std::size_t i = 0; i < presses_.count;) {
    const std::uint64_t place = presses_.places[i], its_block = place & ITS_BLOCK;
    const auto row = static_cast<int>(place >> 32), column = static_cast<int>(place & 0xFFFFFFFF);
    const bool owned = owners_->ownsBlock(blockOf(row), blockOf(column), cells_);
    TreadBlock* const block = owned ? blockAt(blockOf(row), blockOf(column), true) : nullptr;
    for (; i < presses_.count && (presses_.places[i] & ITS_BLOCK) == its_block; ++i) {
      if (block)
        stroke.press(static_cast<float>(presses_.tilts[i]), grid, presses_.places[i], *block);
      else if (owned)
        ++state_.counts.no_memory;
    }
    if (block) block->until = std::max(block->until, stroke.latest);
  }
  return presses_.touched;
}

// Prefetches the nodes, since each source treads at another place.
void TreadMap::prefetch(const TreadBand& band) {
  const int last_row = band.first_row + band.rows - 1,
            first_column = std::max(0, band.first_column);
  const int last_column = band.first_column + band.pitch - 1;
  for (int r = blockOf(band.first_row); r <= blockOf(last_row); ++r)
    for (int c = blockOf(first_column); c <= blockOf(last_column); ++c)
      if (const TreadBlock* block = blockAt(r, c, false)) {
        __builtin_prefetch(block, 1);
        for (int row = std::max(band.first_row, r * SIDE);
             row <= std::min(last_row, r * SIDE + SIDE - 1); ++row)
          for (int column = std::max(first_column, c * SIDE);
               column <= std::min(last_column, c * SIDE + SIDE - 1); column += 2)
            __builtin_prefetch(
                &block->nodes[static_cast<std::size_t>(row % SIDE * SIDE + column % SIDE)], 1);
      }
}

}  // namespace vegetation_sim::grass
