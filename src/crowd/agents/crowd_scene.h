// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "crowd/agents/crowd.h"
#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {

/// A straight wall, real or virtual.
struct Wall {
  Point from{}, to{};     ///< [m]
  double thickness{0.1};  ///< [m]
};

/// What a scenario says of its people; all of it may be left out.
struct Scene {
  CrowdSettings settings;
  Area area;
  std::vector<Wall> walls;
  std::vector<Spawn> spawns;
};

/// Reads the `crowd` section of a scenario: settings, `area`, `walls`, `walkers` one by one,
/// `groups` that stand about a place. `seed` places the groups.
Scene readScene(YamlSection& section, std::uint64_t seed, Faults& faults);

/// People like those of a street, about the place of the first: heights and speeds differ by a few
/// percent, within what a walker may have. @param spread largest offset along x and y [m]. @param
/// variety share of the speed.
std::vector<Spawn> groupOf(const Spawn& like, int count, double spread, double variety,
                           const Random& random);

/// Walls as obstacles.
std::vector<Obstacle> obstaclesOf(const std::vector<Wall>& walls);

}  // namespace vegetation_sim::crowd
