// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/catalogue.h"

namespace vegetation_sim::scenes {

const std::vector<SceneEntry>& allScenes() {
  static const std::vector<SceneEntry> SCENES = [] {
    std::vector<SceneEntry> out;
    for (const auto& family :
         {forestScenes(), touchedTreeScenes(), grassScenes(), canopyScenes(), crowdScenes()})
      out.insert(out.end(), family.begin(), family.end());
    return out;
  }();
  return SCENES;
}

Outcome run(const SceneEntry& scene, int threads) {
  World world(scene.name, threads);
  Hashes hashes;
  scene.begin(world);
  while (world.tick() < STEPS) {
    scene.event(world);
    world.advance();
    if (world.tick() % HASH_EVERY == 0) world.addTo(hashes);
  }
  return {hashes.state.value(), hashes.reference.value(), hashes.display.value(),
          scene.number(world)};
}

}  // namespace vegetation_sim::scenes
