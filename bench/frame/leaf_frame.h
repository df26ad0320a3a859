// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame/laps.h"
#include "frame/scene.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::canopy {

/// Leafy masses of a scenario: the plane's air, and the layers by which displays and sensors move
/// the leaves.
class LeafFrame {
 public:
  explicit LeafFrame(const bench::Scene& scene) : canopy_(*scene.canopy) {
    canopy_.setWind(scene.wind);
    for (int i = 0; i < 2 * bench::FRAME_RATE; ++i) canopy_.advance(next());
  }

  void frame(bench::Laps& laps) {
    canopy_.advance(next());
    laps.lap("air in leaves");
    canopy_.foliage();
    laps.lap("layers of leaves");
  }

 private:
  Nanoseconds next() {
    return bench::FRAME_START + fromSeconds(++frame_ / double{bench::FRAME_RATE});
  }

  Canopy canopy_;
  int frame_{0};
};

}  // namespace vegetation_sim::canopy
