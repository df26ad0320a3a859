// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "crowd/body/body_skeleton.h"
#include "sensors/geometry/rod.h"

namespace vegetation_sim::scan {

/// Limbs of people, for rays.
class People {
 public:
  struct Person {
    std::uint32_t id{0};
    crowd::Skeleton skeleton;
  };
  void set(const std::vector<Person>& people);

  void meet(const Ray& ray, Hit& nearest) const;
  void meetLimb(std::size_t index, const Ray& ray, Hit& nearest) const;
  std::size_t limbs() const { return limbs_.size(); }

 private:
  struct Limb {
    std::uint32_t person{0};
    int part{0};  ///< index in the skeleton
    Rod rod;
  };
  std::vector<Limb> limbs_;
  BoxTree boxes_;
};

}  // namespace vegetation_sim::scan
