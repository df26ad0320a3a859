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

/// People of a scenario; every part is optional.
struct Scene {
  CrowdSettings settings;
  Area area;
  std::vector<Wall> walls;
  std::vector<Spawn> spawns;
};

/// Reads the `crowd` section of a scenario: settings, `area`, `walls`, single `walkers`, and
/// `groups` around a place. `seed` places the groups.
Scene readScene(YamlSection& section, std::uint64_t seed, Faults& faults);

/// Makes varied people around the position of the first; heights and speeds differ by a few
/// percent, within the limits of a walker. @param spread largest offset along x and y [m]. @param
/// variety relative variation of the speed.
std::vector<Spawn> groupOf(const Spawn& like, int count, double spread, double variety,
                           const Random& random);

/// Converts walls to obstacles.
std::vector<Obstacle> obstaclesOf(const std::vector<Wall>& walls);

}  // namespace vegetation_sim::crowd
