// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "vegetation_sim/canopy/plants/leaf.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::canopy {

/// Sets radius and hash of a form from its strips.
inline void finish(Form& form) {
  Hash hash;
  for (const std::vector<Leaf>* part : {&form.leaves, &form.rigid}) {
    hash.add(static_cast<std::uint64_t>(part->size()));
    for (const Leaf& leaf : *part) {
      for (const Vec3& v : {leaf.anchor, leaf.root, leaf.tip, leaf.side}) hash.add(v);
      for (const Vec3& v : {Vec3(leaf.root - leaf.side), Vec3(leaf.root + leaf.side), leaf.tip})
        form.radius = std::max(form.radius, std::sqrt(v.x() * v.x() + v.y() * v.y()));
    }
  }
  form.hash = hash.value();
}

}  // namespace vegetation_sim::canopy
