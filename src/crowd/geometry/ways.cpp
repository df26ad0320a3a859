// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/geometry/ways.h"

#include <algorithm>
#include <numeric>

namespace vegetation_sim::crowd {
namespace {

constexpr std::size_t CHUNK = 64;  // cells between two looks whether a way is known
// A chunk takes less memory than this [bytes], the table of a search with the longest raster
// included.
constexpr std::size_t CHUNK_BYTES = std::size_t{1} << 20;
static_assert(CHUNK * WaySearch::MOST_BYTES_A_CELL + (std::size_t{1} << 18) <= CHUNK_BYTES);
// Searches that are resumed one after the other may need more for a while than they did [bytes].
constexpr std::size_t MOST_RESUMED_BYTES = std::size_t{1} << 27;

}  // namespace

void Ways::setObstacles(const ObstacleGrid& still, double clearance, double cell) {
  raster_ = PlanRaster(still, clearance, cell);
  resume({});
}

void Ways::look(WayQuery& query) const {
  query.aim = query.goal;
  query.is_known = true;
  query.shared = nullptr;
  if (raster_.empty()) return;
  query.start = raster_.nearestFree(query.from);
  query.goal_cell = freeCell(query.goal);
  query.is_known = raster_.isClear(query.from, query.goal, false) ||
                   !raster_.areConnected(raster_.cellAt(query.start), query.goal_cell);
}

// A search is kept while one of its walkers happens to see the goal.
void Ways::assign(std::vector<WayQuery>& queries) {
  closed_ = 0;
  for (const auto& shared : searches_) shared->is_asked = false;
  for (WayQuery& query : queries) {
    const auto found = by_goal_.find(query.goal_cell);
    if (found != by_goal_.end())
      query.shared = found->second;
    else if (!query.is_known)
      query.shared = add(query.goal_cell, raster_.cellAt(query.start));
    if (query.shared) query.shared->is_asked = true;
  }
  dropUnasked();
}

void Ways::follow(WayQuery& query) const {
  if (!query.is_known && query.shared)
    query.is_known = query.shared->search.aimFrom(raster_, query.start, query.aim);
}

void Ways::extend(std::vector<WayQuery>& queries) {
  std::vector<WayQuery*> waiting;
  for (WayQuery& query : queries)
    if (!query.is_known && query.shared) waiting.push_back(&query);
  std::stable_sort(waiting.begin(), waiting.end(), [](const WayQuery* a, const WayQuery* b) {
    return a->shared->age < b->shared->age;
  });
  for (WayQuery* query : waiting) {
    WaySearch& search = query->shared->search;
    const std::uint32_t cell = raster_.cellAt(query->start);
    while (closed_ < MOST_CELLS && bytes_ + CHUNK_BYTES <= most_bytes_ &&
           !search.isKnown(raster_, cell))
      closed_ += expand(search, std::min(CHUNK, MOST_CELLS - closed_));
    search.shrink();
    follow(*query);
  }
}

SharedSearch* Ways::add(std::uint32_t goal, std::uint32_t origin) {
  if (bytes_ + CHUNK_BYTES > most_bytes_) return nullptr;
  searches_.push_back(std::make_unique<SharedSearch>(
      SharedSearch{WaySearch(goal, origin), next_age_++, /*is_asked=*/true}));
  SharedSearch* out = searches_.back().get();
  by_goal_[goal] = out;
  bytes_ += out->search.bytes();
  return out;
}

std::size_t Ways::expand(WaySearch& search, std::size_t count) {
  bytes_ -= search.bytes();
  const std::size_t out = search.expand(raster_, count);
  bytes_ += search.bytes();
  return out;
}

void Ways::dropUnasked() {
  for (const auto& shared : searches_) {
    if (shared->is_asked) continue;
    bytes_ -= shared->search.bytes();
    by_goal_.erase(shared->search.progress().goal);
  }
  searches_.erase(std::remove_if(searches_.begin(), searches_.end(),
                                 [](const auto& shared) { return !shared->is_asked; }),
                  searches_.end());
}

std::vector<WayProgress> Ways::progress() const {
  std::vector<WayProgress> out;
  out.reserve(searches_.size());
  for (const auto& shared : searches_) out.push_back(shared->search.progress());
  return out;
}

void Ways::resume(const std::vector<WayProgress>& progress) {
  searches_.clear();
  by_goal_.clear();
  bytes_ = closed_ = 0;
  const std::size_t cells = static_cast<std::size_t>(raster_.columns()) * raster_.rows();
  for (const WayProgress& saved : progress) {
    if (saved.goal >= cells || saved.origin >= cells || by_goal_.count(saved.goal)) continue;
    SharedSearch* shared = add(saved.goal, saved.origin);
    if (!shared) return;
    std::size_t left = saved.closed;
    while (left > 0 && bytes_ <= MOST_RESUMED_BYTES) {
      const std::size_t closed = expand(shared->search, std::min(CHUNK, left));
      left = closed > 0 ? left - closed : 0;
    }
    shared->search.shrink();
  }
}

}  // namespace vegetation_sim::crowd
