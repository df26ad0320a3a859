// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "modal/measure.h"
#include "scenes/forest/modal_scene.h"

namespace vegetation_sim::bench {
namespace {

constexpr double SKIP = 2.0, DURATION = 5.0;  // seconds 2 to 5 are evaluated
constexpr double STRENGTHS[] = {6.0, 15.0, 30.0};

struct Bent {
  const char *name, *species;
  double scale;
};

forest::Tree grown(const Bent& of, const forest::Species& species) {
  forest::TreeSeed seed;
  seed.seed = 32;
  seed.scale = of.scale;
  return forest::growTree(seed, species, forest::gridLayout(2, 12.0).motion);
}

}  // namespace

void measureBending() {
  std::printf("\nfine modes, RMS of all tips and farthest tip, seconds 2 to 5 of a breeze [m/s]\n");
  std::printf("| %-24s |", "");
  for (const double strength : STRENGTHS) std::printf(" %14.0f |", strength);
  for (const Bent& of :
       {Bent{"young oak", "oak", 0.35}, {"young birch", "birch", 0.35}, {"birch", "birch", 1.0}}) {
    const forest::Species species = forest::shippedSpecies(of.species);
    const forest::Tree tree = grown(of, species);
    std::vector<forest::Swaying> scenes;
    for (const double strength : STRENGTHS)
      scenes.emplace_back(
          tree, species,
          wind::Field({forest::makeBreeze(1, Vec3(strength, 0.3 * strength, 0.0))}, 3), DURATION);
    for (const bool turning : {false, true}) {
      std::printf("\n| %-11s %-12s |", of.name, turning ? "levers turn" : "at rest");
      for (const forest::Swaying& scene : scenes) {
        const forest::Swaying::Off off = scene.modal(SKIP, forest::FINE_MODES, turning);
        std::printf(" %4.1f %%, %4.0f mm |", 100.0 * off.relative, 1e3 * off.farthest);
      }
    }
  }
  std::printf("\n");
}

}  // namespace vegetation_sim::bench
