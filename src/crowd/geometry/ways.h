// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "crowd/geometry/way_search.h"

namespace vegetation_sim::crowd {

/// A search and who needs it.
struct SharedSearch {
  WaySearch search;
  std::uint64_t age{0};  ///< rises from search to search
  bool is_asked{false};  ///< in this tick
};

/// A walker's question for its way in a tick.
struct WayQuery {
  Point from{}, goal{};
  /// Where to head now: the goal itself if it is visible or out of reach, or while its search
  /// waits.
  Point aim{};
  bool is_known{false};
  Point start{};               ///< nearest free place
  std::uint32_t goal_cell{0};  ///< the goal's cell, or the nearest free one
  SharedSearch* shared{nullptr};
};

/// Ways around static obstacles. All searches together close a bounded number of cells in a tick,
/// the oldest search first, and take a bounded memory: the aim of a walker whose search waits is
/// the goal. Goals in one cell share a search. The results depend on obstacles, progress and
/// queries, not on threads or speed.
class Ways {
 public:
  /// Limits of the cells that are closed in a tick and of the memory of all searches [bytes].
  static constexpr std::size_t MOST_CELLS = 65536, MOST_BYTES = 120'000'000;

  explicit Ways(std::size_t most_bytes = MOST_BYTES) : most_bytes_(most_bytes) {}
  void setObstacles(const ObstacleGrid& still, double clearance, double cell);
  const PlanRaster& raster() const { return raster_; }
  bool isReachable(const Point& from, const Point& goal) const {
    return raster_.areConnected(freeCell(from), freeCell(goal));
  }

  // A tick calls the following for all its queries, one after the other. The const functions may
  // run for several queries at once.
  /// Finds the cells of a query, and its aim if it sees its goal or cannot reach it.
  void look(WayQuery& query) const;
  /// Gives each query the search of its goal, and drops searches without a query.
  void assign(std::vector<WayQuery>& queries);
  /// Finds the aim if it follows from what has been searched.
  void follow(WayQuery& query) const;
  /// Searches on for the queries without aim.
  void extend(std::vector<WayQuery>& queries);

  /// Returns the progress of all searches, the oldest first.
  std::vector<WayProgress> progress() const;
  /// Replaces the searches by those that had this progress with the same obstacles. Leaves out what
  /// does not fit to the obstacles or into the memory.
  void resume(const std::vector<WayProgress>& progress);
  std::size_t count() const { return searches_.size(); }
  std::size_t bytes() const { return bytes_; }
  /// Returns the number of cells closed in the last tick.
  std::size_t closed() const { return closed_; }

 private:
  std::uint32_t freeCell(const Point& place) const {
    return raster_.cellAt(raster_.nearestFree(place));
  }
  SharedSearch* add(std::uint32_t goal, std::uint32_t origin);
  std::size_t expand(WaySearch& search, std::size_t count);
  void dropUnasked();

  PlanRaster raster_;
  std::vector<std::unique_ptr<SharedSearch>> searches_;  ///< by rising age
  std::map<std::uint32_t, SharedSearch*> by_goal_;
  std::uint64_t next_age_{0};
  std::size_t most_bytes_, bytes_{0}, closed_{0};
};

}  // namespace vegetation_sim::crowd
