// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>

#include "sensors/geometry/ray.h"

namespace vegetation_sim::scan {

/// The nearest hit on items that may be tested in any order: of hits at equal distances that on the
/// item with the lowest rank counts, as if all items were tested in the order of their ranks.
class RankedHit {
 public:
  /// @param hit a hit on other objects, which counts at equal distances.
  explicit RankedHit(Hit& hit) : hit_(hit) {}

  const Hit& hit() const { return hit_; }
  /// @param rank at least 1. @param meet replaces a hit by one that is nearer, and returns whether
  /// it did.
  template <class Meet>
  void offer(std::uint64_t rank, Meet&& meet) {
    const double distance = hit_.distance;
    if (rank < rank_) hit_.distance = above(distance);
    if (meet(hit_))
      rank_ = rank;
    else
      hit_.distance = distance;
  }

 private:
  /// Returns the next larger number. Requires distance >= 0, as that of every hit.
  static double above(double distance) {
    std::uint64_t bits = 0;
    distance += 0.0;  // makes -0 positive
    std::memcpy(&bits, &distance, sizeof bits);
    ++bits;
    std::memcpy(&distance, &bits, sizeof bits);
    return distance;
  }

  Hit& hit_;
  std::uint64_t rank_{0};
};

}  // namespace vegetation_sim::scan
