// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/threads/thread_pool.h"
#include "sensors/plants/posed_plant.h"
#include "sensors/traversal/posed_set.h"

namespace vegetation_sim::scan {

/// The leafy plants of a canopy around a sensor, which stay grown while they are within its range.
class Plants {
 public:
  /// @param most_leaves limit for all plants but at least one plant; the farthest plants are left
  /// out.
  explicit Plants(std::size_t most_leaves = 200000) : most_leaves_(most_leaves) {}

  /// Poses the plants that reach into a ball. @param layout_hash of `layout`. @param foliage must
  /// be of the same layout.
  void update(const canopy::Layout& layout, std::uint64_t layout_hash,
              const canopy::Foliage& foliage, const Vec3& centre, double radius,
              ThreadPool& threads);
  void clear() { *this = Plants(most_leaves_); }

  /// Replaces `nearest` by a nearer hit on a leaf or stem. Of hits at equal distances that on the
  /// plant that comes first in all(), there that on the part that comes first, counts.
  void meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
    plants_.meet(ray, narrow, nearest);
  }

  const std::vector<std::shared_ptr<PosedPlant>>& all() const { return plants_.all(); }
  /// Returns the number of leaves and faces that the plants have uncut.
  std::size_t leaves() const { return leaves_; }
  /// Texts for the user about textures that are not read; their faces are opaque.
  const std::vector<std::string>& textureFaults() const { return masks_.faults(); }
  /// Returns the number of plants that exceeded the limit in the last update().
  std::size_t leftOut() const { return left_out_; }

 private:
  void choose(const canopy::Layout& layout, const Vec3& centre, double radius,
              std::vector<std::uint32_t>& out);

  std::size_t most_leaves_;
  std::uint64_t layout_hash_{0};
  PlantMasks masks_;             ///< of the layout
  PosedSet<PosedPlant> plants_;  ///< nearest first
  std::size_t leaves_{0}, left_out_{0};
};

}  // namespace vegetation_sim::scan
