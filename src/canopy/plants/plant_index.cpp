// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/plant_index.h"

#include <algorithm>

namespace vegetation_sim::canopy {

PlantIndex::PlantIndex(const std::vector<Plant>& plants) {
  nodes_.reserve(plants.size());
  for (const Plant& plant : plants)
    nodes_.push_back({{plant.position.x(), plant.position.y()}, static_cast<int>(nodes_.size())});
  sort(0, nodes_.size(), 0);
}

void PlantIndex::sort(std::size_t begin, std::size_t end, int axis) {
  if (end - begin < 2) return;
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [axis](const Node& a, const Node& b) { return a.at[axis] < b.at[axis]; });
  sort(begin, middle, 1 - axis);
  sort(middle + 1, end, 1 - axis);
}

int PlantIndex::nearest(const Vec3& place) const {
  Found best;
  search(0, nodes_.size(), 0, place, best);
  return best.id;
}

void PlantIndex::search(std::size_t begin, std::size_t end, int axis, const Vec3& place,
                        Found& best) const {
  if (begin == end) return;
  const std::size_t middle = (begin + end) / 2;
  const Node& node = nodes_[middle];
  const double x = node.at[0] - place.x(), y = node.at[1] - place.y(), square = x * x + y * y;
  if (best.id < 0 || square < best.square || (square == best.square && node.id < best.id))
    best = {square, node.id};
  const double beyond = node.at[axis] - place[axis];
  const bool low_first = beyond > 0.0;
  const auto half = [&](bool low) {
    search(low ? begin : middle + 1, low ? middle : end, 1 - axis, place, best);
  };
  half(low_first);
  if (beyond * beyond <= best.square) half(!low_first);
}

}  // namespace vegetation_sim::canopy
