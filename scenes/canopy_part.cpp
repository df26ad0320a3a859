// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/canopy_part.h"

namespace vegetation_sim::scenes {

CanopyPart::CanopyPart(const Scenario& scenario)
    : canopy_(*scenario.canopy), replica_(*scenario.canopy) {
  const canopy::Layout& layout = canopy_.layout();
  for (const canopy::Plant& plant : layout.plants)
    leaves_.push_back(canopy::grow(layout.kinds[plant.kind], plant).leaves);
  setWind(scenario.wind);
}

void CanopyPart::advance(Nanoseconds stamp) {
  canopy_.advance(stamp);
  replica_.apply(canopy_.update(false));
}

void CanopyPart::addTo(Hashes& hashes) {
  hashes.state.add(canopy_.snapshot().hash());
  const canopy::Foliage& own = canopy_.foliage();
  const canopy::Foliage& shown = replica_.foliage();
  for (std::size_t plant = 0; plant < leaves_.size(); ++plant)
    for (std::size_t i = 0; i < leaves_[plant].size(); i += 7) {
      hashes.reference.add(own.move(leaves_[plant][i], plant).tip);
      hashes.display.add(shown.move(leaves_[plant][i], plant).tip);
    }
  for (int layer = 0; layer < shown.layers(); ++layer)
    addFloats(shown.sheet(layer), hashes.display);
}

double CanopyPart::meanDisplacement() {
  double sum = 0.0, count = 0.0;
  for (std::size_t plant = 0; plant < leaves_.size(); ++plant)
    for (const canopy::Leaf& leaf : leaves_[plant]) {
      sum += length(Vec3(canopy_.foliage().move(leaf, plant).tip - leaf.tip));
      count += 1.0;
    }
  return sum / count;
}

}  // namespace vegetation_sim::scenes
