// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/way_search.h"

#include <algorithm>

namespace vegetation_sim::crowd {
namespace {

// A mark has the length modulo 64. Lengths that are compared are those of neighbours, found over
// closed cells beside them, so they differ by less than 32.
constexpr std::uint8_t CLOSED = 128, REACHED = 64, LENGTH = 63;

// Returns how much longer the way of a mark is than a length.
int differenceOf(std::uint8_t mark, std::uint32_t length) {
  const std::uint32_t ahead = (mark - length) & LENGTH;
  return static_cast<int>(ahead) - (ahead >= 32 ? 64 : 0);
}

}  // namespace

void WaySearch::begin(const PlanRaster& raster) {
  columns_ = static_cast<std::uint32_t>(raster.columns());
  block_columns_ = (columns_ + BLOCK - 1) / BLOCK;
  blocks_.resize(block_columns_ *
                 ((static_cast<std::uint32_t>(raster.rows()) + BLOCK - 1) / BLOCK));
  origin_column_ = progress_.origin % columns_;
  origin_row_ = progress_.origin / columns_;
  const Neighbour goal{progress_.goal, progress_.goal % columns_, progress_.goal / columns_, 0};
  estimate_ = distanceFromOrigin(goal.column, goal.row);
  open(goal, 0);
}

std::uint8_t WaySearch::markAt(std::uint32_t column, std::uint32_t row) const {
  const std::unique_ptr<Block>& block = blocks_[blockOf(column, row)];
  return block ? (*block)[placeInBlock(column, row)] : std::uint8_t{0};
}

std::uint8_t& WaySearch::mark(std::uint32_t column, std::uint32_t row) {
  std::unique_ptr<Block>& block = blocks_[blockOf(column, row)];
  if (!block) {
    block = std::make_unique<Block>();
    ++block_count_;
  }
  return (*block)[placeInBlock(column, row)];
}

// Returns the length of a way without obstacles. It never falls by more than the cost of a step, so
// the first way that closes a cell is a shortest one.
std::uint32_t WaySearch::distanceFromOrigin(std::uint32_t column, std::uint32_t row) const {
  const auto apart = [](std::uint32_t a, std::uint32_t b) { return a < b ? b - a : a - b; };
  const std::uint32_t across = apart(column, origin_column_), along = apart(row, origin_row_);
  return STRAIGHT * std::max(across, along) + (DIAGONAL - STRAIGHT) * std::min(across, along);
}

void WaySearch::open(const Neighbour& at, std::uint32_t length) {
  mark(at.column, at.row) = static_cast<std::uint8_t>(REACHED | (length & LENGTH));
  buckets_[(length + distanceFromOrigin(at.column, at.row)) % BUCKETS].push_back(at.cell);
  ++open_;
}

std::size_t WaySearch::expand(const PlanRaster& raster, std::size_t count) {
  if (blocks_.empty()) begin(raster);
  std::size_t closed = 0;
  while (closed < count && open_ > 0) {
    std::vector<std::uint32_t>& bucket = buckets_[estimate_ % BUCKETS];
    if (bucket.empty()) {
      ++estimate_;
      continue;
    }
    const std::uint32_t cell = bucket.back(), column = cell % columns_, row = cell / columns_;
    bucket.pop_back();
    --open_;
    std::uint8_t& own = mark(column, row);
    if (own & CLOSED) continue;  // a shorter way was found before
    own |= CLOSED;
    ++closed;
    const std::uint32_t length = estimate_ - distanceFromOrigin(column, row);
    raster.visitNeighbours(cell, [&](const Neighbour& next) {
      const std::uint8_t known = markAt(next.column, next.row);
      if (known & CLOSED) return;
      if ((known & REACHED) && differenceOf(known, length + next.cost) <= 0) return;
      open(next, length + next.cost);
    });
  }
  progress_.closed += static_cast<std::uint32_t>(closed);
  return closed;
}

// Finds the neighbour nearest to the goal, the cell itself if none is nearer. Returns false unless
// the lengths of all neighbours are known.
bool WaySearch::findNext(const PlanRaster& raster, std::uint32_t cell, std::uint32_t& next) const {
  if (blocks_.empty()) return false;
  const std::uint8_t own = markAt(cell % columns_, cell / columns_);
  bool known = own & CLOSED;
  if (!known) return false;
  int nearest = 0;
  next = cell;
  raster.visitNeighbours(cell, [&](const Neighbour& at) {
    const std::uint8_t mark = markAt(at.column, at.row);
    known = known && (mark & CLOSED);
    const int difference = differenceOf(mark, own);
    if (difference >= nearest) return;
    nearest = difference;
    next = at.cell;
  });
  return known;
}

bool WaySearch::follow(const PlanRaster& raster, std::uint32_t cell, Path& path) const {
  for (std::uint32_t& at : path) {
    if (!findNext(raster, cell, at)) return false;
    cell = at;
  }
  return true;
}

bool WaySearch::isKnown(const PlanRaster& raster, std::uint32_t cell) const {
  Path path;
  return follow(raster, cell, path);
}

bool WaySearch::aimFrom(const PlanRaster& raster, const Point& from, Point& aim) const {
  Path path;
  if (!follow(raster, raster.cellAt(from), path)) return false;
  std::size_t i = LOOK_AHEAD - 1;
  while (i > 0 && !raster.isClear(from, raster.centreOf(path[i]), false)) i = i * 2 / 3;
  aim = raster.centreOf(path[i]);
  return true;
}

void WaySearch::shrink() {
  for (std::vector<std::uint32_t>& bucket : buckets_) bucket.shrink_to_fit();
}

std::size_t WaySearch::bytes() const {
  return sizeof(*this) + blocks_.size() * sizeof(blocks_[0]) + block_count_ * sizeof(Block) +
         open_ * sizeof(std::uint32_t);
}

}  // namespace vegetation_sim::crowd
