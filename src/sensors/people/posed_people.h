// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "crowd/body/body_skeleton.h"
#include "sensors/geometry/ranked_hit.h"
#include "sensors/traversal/rod_tree.h"

namespace vegetation_sim::scan {

/// Limbs of people, for rays.
class People {
 public:
  struct Person {
    std::uint32_t id{0};
    crowd::Skeleton skeleton;
  };
  void set(const std::vector<Person>& people);

  /// Replaces `nearest` by a nearer hit; of hits at equal distances that on the first limb counts.
  void meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const;
  bool meetLimb(std::size_t index, const Ray& ray, Hit& nearest) const;
  std::size_t limbs() const { return limbs_.size(); }
  /// Returns the id of the person of a limb. Limbs of a person follow each other.
  std::uint32_t personOf(std::size_t limb) const { return limbs_[limb].person; }
  const std::vector<Rod>& rods() const { return rods_; }

 private:
  struct Limb {
    std::uint32_t person{0};
    int part{0};  ///< index in the skeleton
  };
  std::vector<Limb> limbs_;
  std::vector<Rod> rods_;  ///< of limbs_
  RodTree rod_tree_;
};

}  // namespace vegetation_sim::scan
