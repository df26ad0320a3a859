// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sensors/geometry/ranked_hit.h"
#include "sensors/traversal/wide_walk.h"

namespace vegetation_sim::scan {

/// Takes all plants out of a list, by their ids.
template <class Plant>
std::map<std::uint32_t, std::shared_ptr<Plant>> takeById(
    std::vector<std::shared_ptr<Plant>>& plants) {
  std::map<std::uint32_t, std::shared_ptr<Plant>> out;
  for (std::shared_ptr<Plant>& plant : plants) out[plant->id()] = std::move(plant);
  plants.clear();
  return out;
}

/// Posed plants around a sensor, in a wide tree.
/// @tparam Plant has id(), parts(), bounds() and meet().
template <class Plant>
class PosedSet {
 public:
  using Pointer = std::shared_ptr<Plant>;

  /// Takes all plants out, by their ids.
  std::map<std::uint32_t, Pointer> take() { return takeById(plants_); }
  /// Replaces all plants by posed ones. @param origin place near them [m].
  void set(std::vector<Pointer> plants, const Vec3& origin) {
    plants_ = std::move(plants);
    std::vector<Box> items;
    items.reserve(plants_.size());
    first_ranks_.clear();
    std::uint64_t rank = 1;
    for (const Pointer& plant : plants_) {
      Box box = plant->bounds();
      // A plant without parts is a point, which rays may enter and find empty.
      if (box.isEmpty()) box.add(origin, 0.0);
      items.push_back({box.low - origin, box.high - origin});
      first_ranks_.push_back(rank);
      rank += plant->parts();
    }
    boxes_.build(items);
    std::vector<Box> groups;
    for (int group = 0; group < boxes_.groups(); ++group) groups.push_back(items[itemOf(group)]);
    boxes_.fit(groups, origin);
  }

  /// Replaces `nearest` by a nearer hit. Of hits at equal distances that on the plant that comes
  /// first counts, there that on the part that comes first.
  void meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
    RankedHit ranked(nearest);
    visit(ray, narrow, nearest, [&](std::size_t plant) {
      plants_[plant]->meet(ray, narrow, first_ranks_[plant], ranked);
    });
  }
  const std::vector<Pointer>& all() const { return plants_; }

 private:
  /// Calls visit(plant), which may reduce `nearest`, for each plant that a ray may hit; near ones
  /// first.
  template <class Visit>
  void visit(const Ray& ray, const FloatRay& narrow, const Hit& nearest, Visit&& visit) const {
    if (plants_.empty()) return;
    WideWalk walk(WalkedTree(boxes_), ray, narrow, nearest.distance);
    for (int group = nextGroup(walk); group >= 0; group = nextGroup(walk)) {
      visit(itemOf(group));
      walk.limit = limitOf(nearest.distance);
    }
  }
  std::size_t itemOf(int group) const { return static_cast<std::size_t>(boxes_.item(group, 0)); }

  std::vector<Pointer> plants_;
  std::vector<std::uint64_t> first_ranks_;  ///< of the parts of each plant
  WideTree boxes_{1};                       ///< of the plants
};

}  // namespace vegetation_sim::scan
