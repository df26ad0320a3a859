// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/world.h"

namespace vegetation_sim::scenes {

constexpr int STEPS = 600;      ///< of every scene
constexpr int HASH_EVERY = 60;  ///< steps between the states that are hashed

/// A scene that tests, benches and demos share: a scenario, and what happens in it.
struct SceneEntry {
  const char* name;          ///< also of its YAML file
  const char* covers;        ///< one line
  const char* measured;      ///< what the number says, with its unit
  void (*begin)(World&);     ///< before the first tick
  void (*event)(World&);     ///< before each tick
  double (*number)(World&);  ///< after the last tick
};

/// All scenes, in the order of the golden file.
const std::vector<SceneEntry>& allScenes();

std::vector<SceneEntry> forestScenes();
std::vector<SceneEntry> touchedTreeScenes();
std::vector<SceneEntry> grassScenes();
std::vector<SceneEntry> canopyScenes();
std::vector<SceneEntry> crowdScenes();

/// What a run of a scene gives; the hashes are chained over every HASH_EVERY-th tick.
struct Outcome {
  std::uint64_t state{0}, reference{0}, display{0};
  double number{0.0};
};
Outcome run(const SceneEntry& scene, int threads = 1);

}  // namespace vegetation_sim::scenes
