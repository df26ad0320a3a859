// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/crowd_part.h"

namespace vegetation_sim::scenes {

CrowdPart::CrowdPart(const Scenario& scenario, int threads)
    : crowd_(scenario.seed, scenario.crowd->settings, scenario.crowd->area, scenario.terrain) {
  crowd_.setThreads(threads);
  crowd_.setObstacles(crowd::obstaclesOf(scenario.crowd->walls));
  for (const crowd::Spawn& spawn : scenario.crowd->spawns) crowd_.spawn(spawn);
}

std::vector<crowd::Skeleton> CrowdPart::bodies() const {
  std::vector<crowd::Skeleton> out;
  for (const crowd::Walker& walker : crowd_.walkers())
    out.push_back(crowd::skeletonOf(walker, crowd_.terrain()));
  return out;
}

void CrowdPart::addTo(Hashes& hashes) const {
  hashes.state.add(crowd_.snapshot().hash());
  for (const crowd::Skeleton& body : bodies())
    for (const crowd::Limb& limb : body) {
      hashes.reference.add(limb.from);
      hashes.reference.add(limb.to);
    }
}

double CrowdPart::meanDistance() const {
  double sum = 0.0;
  for (const crowd::Walker& walker : crowd_.walkers()) sum += length(walker.position);
  return sum / static_cast<double>(crowd_.walkers().size());
}

}  // namespace vegetation_sim::scenes
