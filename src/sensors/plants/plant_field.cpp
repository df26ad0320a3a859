// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/plant_field.h"

#include <algorithm>
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
  auto known = plants_.take();
  if (layout_hash_ != layout_hash || !masks_.areOf(layout)) {
    known.clear();
    masks_ = PlantMasks(layout);
  }
  layout_hash_ = layout_hash;
  std::vector<std::uint32_t> chosen;
  choose(layout, centre, radius, chosen);
  std::vector<std::shared_ptr<PosedPlant>> plants;
  for (const std::uint32_t id : chosen) plants.push_back(std::move(known[id]));
  const std::size_t parts = threads.size();
  threads.run(parts, [&](std::size_t first) {
    for (std::size_t i = first; i < chosen.size(); i += parts) {
      const double height = foliage.cutHeight(chosen[i]);
      if (!plants[i] || plants[i]->cutHeight() != height)
        plants[i] = std::make_shared<PosedPlant>(layout, chosen[i], height,
                                                 masks_.of(layout.plants[chosen[i]].kind));
      plants[i]->pose(foliage);
    }
  });
  plants_.set(std::move(plants), centre);
}

}  // namespace vegetation_sim::scan
