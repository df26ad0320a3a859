// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plants/plant.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {

/// Transforms a plant at the origin into the world.
class Placing {
 public:
  Placing(const Plant& plant, double scale)
      : foot_(plant.position), scale_(scale), turn_(sinCos(plant.yaw)) {}

  Vec3 turned(const Vec3& v) const {
    return {turn_.cos * v.x() - turn_.sin * v.y(), turn_.sin * v.x() + turn_.cos * v.y(), v.z()};
  }
  Vec3 placed(const Vec3& v) const { return foot_ + scale_ * turned(v); }
  Leaf placed(Leaf leaf) const {
    leaf.anchor = placed(leaf.anchor);
    leaf.root = placed(leaf.root);
    leaf.tip = placed(leaf.tip);
    leaf.side = scale_ * turned(leaf.side);
    return leaf;
  }

 private:
  Vec3 foot_;
  double scale_;
  SinCos turn_;
};

}  // namespace vegetation_sim::canopy
