// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/plants/posed_crown.h"
#include "sensors/traversal/posed_set.h"

namespace vegetation_sim::scan {

/// The crowns of a canopy on trees around a sensor.
class Crowns {
 public:
  /// @param most_leaves limit for all crowns but at least one crown; the last ones are left out.
  explicit Crowns(std::size_t most_leaves = 200000) : most_leaves_(most_leaves) {}

  /// Poses the crowns. @param sources nearest first. @param version changes whenever leaves of
  /// sources do. @param origin place near them [m].
  void update(const std::vector<CrownSource>& sources, int version, const canopy::Foliage& foliage,
              const Vec3& origin, ThreadPool& threads);
  /// Replaces `nearest` by a nearer hit on a leaf. Of hits at equal distances that on the crown
  /// that comes first in all(), there on the leaf that comes first, counts.
  void meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
    crowns_.meet(ray, narrow, nearest);
  }

  const std::vector<std::shared_ptr<PosedCrown>>& all() const { return crowns_.all(); }
  std::size_t leaves() const { return leaves_; }
  /// Returns the number of crowns that exceeded the limit in the last update().
  std::size_t leftOut() const { return left_out_; }

 private:
  std::size_t most_leaves_;
  int version_{0};
  PosedSet<PosedCrown> crowns_;
  std::size_t leaves_{0}, left_out_{0};
};

}  // namespace vegetation_sim::scan
