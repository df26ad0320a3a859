// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "crowd/agents/crowd.h"
#include "crowd/body/body_skeleton.h"
#include "scenes/hashing.h"
#include "scenes/scenario.h"

namespace vegetation_sim::scenes {

/// The people of a scene among its walls.
class CrowdPart {
 public:
  CrowdPart(const Scenario& scenario, int threads);

  void advance(Nanoseconds stamp) { crowd_.advance(stamp); }
  void addTo(Hashes& hashes) const;

  crowd::Crowd& crowd() { return crowd_; }
  std::vector<crowd::Skeleton> bodies() const;
  /// Mean distance of all walkers from the origin [m].
  double meanDistance() const;

 private:
  crowd::Crowd crowd_;
};

}  // namespace vegetation_sim::scenes
