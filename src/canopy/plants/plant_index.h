// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/plants/plant.h"

namespace vegetation_sim::canopy {

/// Plants by position in a k-d tree of two dimensions.
class PlantIndex {
 public:
  explicit PlantIndex(const std::vector<Plant>& plants);

  /// Returns the id of the plant whose foot is nearest horizontally, the lowest of several; -1 if
  /// there is none.
  int nearest(const Vec3& place) const;

 private:
  struct Node {
    double at[2];  // x, y [m]
    int id;
  };
  struct Found {
    double square{0.0};  // squared distance
    int id{-1};
  };
  void sort(std::size_t begin, std::size_t end, int axis);
  void search(std::size_t begin, std::size_t end, int axis, const Vec3& place, Found& best) const;

  std::vector<Node> nodes_;  // each range is split along an axis by its middle node
};

}  // namespace vegetation_sim::canopy
