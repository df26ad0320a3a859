// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Plants that tools cut.
#include <algorithm>

#include "canopy/contact/plant_pusher.h"
#include "canopy/plants/stubble.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::canopy {

bool Canopy::canCut(std::uint32_t plant, double height) const {
  const Plant& own = layout_.plants[plant];
  const PlantKind& kind = layout_.kinds[own.kind];
  return kind.shape != PlantShape::TRELLIS &&
         height < std::min(memory_.push.heightOf(plant), own.scale * kind.height);
}

std::vector<CutPiece> Canopy::cut(const std::vector<std::uint32_t>& plants, double height) {
  Stubble cuts;
  for (const std::uint32_t plant : plants) cuts[plant] = height;
  checkStubble(cuts, layout_.plants.size(), "cut: ");
  std::vector<CutPiece> out;
  for (const std::uint32_t plant : plants) {
    if (!canCut(plant, height)) continue;
    const Plant& own = layout_.plants[plant];
    const double top = own.scale * layout_.kinds[own.kind].height;
    out.push_back({plant, std::min(memory_.push.heightOf(plant), top) - height});
    memory_.push.stubble[plant] = height;
    if (pusher_->fibresOf(plant, height).length < SHORTEST_FIBRES) memory_.push.plants.erase(plant);
  }
  stale_ = stale_ || !out.empty();
  return out;
}

}  // namespace vegetation_sim::canopy
