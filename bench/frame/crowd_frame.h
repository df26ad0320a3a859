// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/body/body_skeleton.h"
#include "frame/laps.h"
#include "frame/scene.h"

namespace vegetation_sim::crowd {

/// The people of a scenario among its walls: a tick of their motion, and their bodies.
class CrowdFrame {
 public:
  explicit CrowdFrame(const bench::Scene& scene)
      : crowd_(1, scene.crowd->settings, scene.crowd->area, scene.terrain) {
    crowd_.setObstacles(obstaclesOf(scene.crowd->walls));
    for (const Spawn& spawn : scene.crowd->spawns) crowd_.spawn(spawn);
    for (int i = 0; i < 2 * bench::FRAME_RATE; ++i) crowd_.advance(next());
  }

  void frame(bench::Laps& laps) {
    crowd_.advance(next());
    laps.lap("ways of people");
    bodies_.clear();
    for (const Walker& walker : crowd_.walkers())
      bodies_.push_back(skeletonOf(walker, crowd_.terrain()));
    laps.lap("bodies of people");
  }

 private:
  Nanoseconds next() {
    return bench::FRAME_START + fromSeconds(++frame_ / double{bench::FRAME_RATE});
  }

  Crowd crowd_;
  std::vector<Skeleton> bodies_;
  int frame_{0};
};

}  // namespace vegetation_sim::crowd
