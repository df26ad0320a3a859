// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/plant_field.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vegetation_sim::scan {
namespace {

// Leaves are displaced by less than 0.4 of the height of their plant.
constexpr double ROOM = 1.5;

double reachOf(const canopy::Layout& layout, const canopy::Plant& plant) {
  const canopy::PlantKind& kind = layout.kinds[plant.kind];
  return ROOM * plant.scale * (kind.height + kind.radius + kind.leaf_length);
}

}  // namespace

// Chooses the plants that may reach into a ball, nearest first, within the limit.
void Plants::choose(const canopy::Layout& layout, const Vec3& centre, double radius,
                    std::vector<std::uint32_t>& out) {
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (std::size_t id = 0; id < layout.plants.size(); ++id) {
    const canopy::Plant& plant = layout.plants[id];
    const double distance = length(plant.position - centre);
    if (distance < radius + reachOf(layout, plant))
      sorted.emplace_back(distance, static_cast<std::uint32_t>(id));
  }
  std::sort(sorted.begin(), sorted.end());
  leaves_ = 0;
  for (const auto& [distance, id] : sorted) {
    const std::size_t more = canopy::leafCount(layout.kinds[layout.plants[id].kind]);
    if (!out.empty() && leaves_ + more > most_leaves_) break;
    leaves_ += more;
    out.push_back(id);
  }
  left_out_ = sorted.size() - out.size();
}

void Plants::update(const canopy::Layout& layout, std::uint64_t layout_hash,
                    const canopy::Foliage& foliage, const Vec3& centre, double radius,
                    ThreadPool& threads) {
  std::map<std::uint32_t, std::shared_ptr<PosedPlant>> known;
  if (layout_hash_ == layout_hash)
    for (auto& plant : plants_) known[plant->id()] = std::move(plant);
  layout_hash_ = layout_hash;
  std::vector<std::uint32_t> chosen;
  choose(layout, centre, radius, chosen);
  plants_.assign(chosen.size(), nullptr);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    if (const auto found = known.find(chosen[i]); found != known.end()) plants_[i] = found->second;
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < chosen.size(); i += parts) {
      if (!plants_[i]) plants_[i] = std::make_shared<PosedPlant>(layout, chosen[i]);
      plants_[i]->pose(foliage);
    }
  });
  fitBoxes(centre);
}

void Plants::fitBoxes(const Vec3& origin) {
  origin_ = origin;
  std::vector<Box> items;
  items.reserve(plants_.size());
  first_ranks_.clear();
  std::uint64_t rank = 1;
  Box all;
  for (const auto& plant : plants_) {
    Box box = plant->bounds();
    // A plant without leaves and stems is a point, which rays may enter and find empty.
    if (box.isEmpty()) box.add(origin, 0.0);
    items.push_back({box.low - origin, box.high - origin});
    all.add(items.back());
    first_ranks_.push_back(rank);
    rank += plant->parts();
  }
  extent_ = extentOf(all);
  boxes_.build(items);
  std::vector<FloatBox> groups;
  for (int group = 0; group < boxes_.groups(); ++group)
    groups.push_back(enclose(items[static_cast<std::size_t>(boxes_.item(group, 0))]));
  boxes_.fit(groups);
}

void Plants::meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
  if (plants_.empty()) return;
  RankedHit ranked(nearest);
  WideWalk walk(boxes_, ray, narrow, origin_, extent_, nearest.distance);
  for (int group = nextGroup(walk); group >= 0; group = nextGroup(walk)) {
    const auto plant = static_cast<std::size_t>(boxes_.item(group, 0));
    plants_[plant]->meet(ray, narrow, first_ranks_[plant], ranked);
    walk.limit = limitOf(nearest.distance);
  }
}

}  // namespace vegetation_sim::scan
