// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/cover/cover_join.h"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

#include "core/shards/shard_split.h"
#include "nodes/grass/cover/grass_cover.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_WAITING = 16;  // parts of one shard

bool isSameGrid(const nav_msgs::MapMetaData& a, const nav_msgs::MapMetaData& b) {
  return a.width == b.width && a.height == b.height && a.resolution == b.resolution;
}

}  // namespace

std::optional<GrassCover> CoverJoin::begin(GrassCover own, double drag) {
  std::optional<GrassCover> before;
  const Nanoseconds stamp = fromMsg(own.header.stamp);
  if (!since_) since_ = stamp;
  if (begun_ && (hasHeardAll() || isSilentShard(*since_, stamp))) before = join();
  grid_ = own.info;
  begun_ = std::move(own);
  drag_ = drag;
  return before;
}

void CoverJoin::check(const GrassCoverPart& part) const {
  Faults faults;
  if (part.shard == 0 || part.shard >= shards_)
    faults.add("cover: shard = " + std::to_string(part.shard) + " is outside 1 to " +
               std::to_string(shards_ - 1));
  if (part.crush.size() != part.cells.size() || part.age.size() != part.cells.size())
    faults.add("cover: cells, crush and age have " + std::to_string(part.cells.size()) + ", " +
               std::to_string(part.crush.size()) + " and " + std::to_string(part.age.size()) +
               " entries");
  faults.throwIfAny();
  const std::uint64_t count = std::uint64_t{part.info.width} * part.info.height;
  for (std::size_t i = 0; i < part.cells.size(); ++i) {
    if (part.cells[i] >= count || (i > 0 && part.cells[i] <= part.cells[i - 1]))
      throw InvalidInput("cover: cell = " + std::to_string(part.cells[i]) +
                         " is outside the grid or not in ascending order");
    if (!(part.crush[i] >= 0.f && part.crush[i] <= 1.f) ||
        !(part.age[i] >= 0.f && std::isfinite(part.age[i])))
      throw InvalidInput("cover: crush = " + std::to_string(part.crush[i]) +
                         " or age = " + std::to_string(part.age[i]) +
                         " is impossible; allowed are 0 to 1, and "
                         "from 0 s on");
  }
}

void CoverJoin::add(const GrassCoverPart& part) {
  check(part);
  if (grid_ && !isSameGrid(part.info, *grid_))
    throw InvalidInput("cover: the grid of shard " + std::to_string(part.shard) +
                       " differs; cover_resolution must be that of all shards");
  auto& waiting = parts_[part.shard];
  waiting[fromMsg(part.header.stamp)] = part;
  // Maps are joined in their order, so the earliest parts are needed first.
  if (waiting.size() > MOST_WAITING) waiting.erase(std::prev(waiting.end()));
}

bool CoverJoin::hasHeardAll() const {
  for (std::uint32_t shard = 1; shard < shards_; ++shard)
    if (const auto found = parts_.find(shard); found == parts_.end() || found->second.empty())
      return false;
  return true;
}

std::optional<GrassCover> CoverJoin::take() {
  if (!begun_) return std::nullopt;
  const Nanoseconds stamp = fromMsg(begun_->header.stamp);
  for (std::uint32_t shard = 1; shard < shards_; ++shard)
    if (parts_[shard].count(stamp) == 0) return std::nullopt;
  GrassCover out = join();
  begun_.reset();
  return out;
}

// Parts of earlier ticks are needed no more; the newest one stays for a shard that falls silent.
GrassCover CoverJoin::join() {
  GrassCover out = std::move(*begun_);
  const Nanoseconds stamp = fromMsg(out.header.stamp);
  for (auto& [shard, waiting] : parts_) {
    auto after = waiting.upper_bound(stamp);
    if (after == waiting.begin()) continue;
    const auto newest = std::prev(after);
    if (isSameGrid(newest->second.info, out.info)) addTreads(newest->second, out);
    waiting.erase(waiting.begin(), newest);
  }
  addResistance(drag_, out);
  return out;
}

void CoverJoin::clear() {
  begun_.reset();
  since_.reset();
  parts_.clear();
}

}  // namespace vegetation_sim
