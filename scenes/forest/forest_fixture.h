// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "forest/forest.h"
#include "package_folder.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

inline const std::vector<std::string>& speciesNames() {
  static const std::vector<std::string> NAMES{"oak", "pine", "birch", "willow"};
  return NAMES;
}

/// A shipped species, whose branches never break.
inline Species shippedSpecies(const std::string& name) {
  Species out = loadSpecies(std::string(PACKAGE_FOLDER) + "/config/species/" + name + ".yaml");
  out.strength = 0.0;
  return out;
}

/// `side` x `side` trees of all species, `spacing` metres apart, from the origin on.
inline Layout gridLayout(int side, double spacing) {
  Layout out;
  for (const std::string& name : speciesNames()) out.species.push_back(shippedSpecies(name));
  for (int i = 0; i < side * side; ++i) {
    TreeSeed seed;
    seed.seed = static_cast<std::uint64_t>(i) + 1000;
    seed.species = static_cast<std::uint16_t>(i % 4);
    seed.position = Vec3(spacing * (i % side), spacing * (i / side), 0.0);
    seed.yaw = 0.1 * i;
    out.trees.push_back(seed);
  }
  return out;
}

inline std::shared_ptr<const terrain::HeightMap> flatTerrain() {
  return std::make_shared<const terrain::HeightMap>();
}

inline wind::Primitive makeDisk(std::uint32_t id, const Vec3& centre, double radius,
                                const Vec3& velocity) {
  wind::Primitive out;
  out.id = id;
  out.name = "disc_" + std::to_string(id);
  out.kind = wind::Kind::DISK;
  out.fade_in = out.fade_out = 0.0;
  out.trajectory = {{0, centre}};
  out.radius = radius;
  out.velocity = velocity;
  return out;
}

inline wind::Primitive makeBreeze(std::uint32_t id, const Vec3& velocity) {
  wind::Primitive out;
  out.id = id;
  out.name = "breeze_" + std::to_string(id);
  out.kind = wind::Kind::BREEZE;
  out.fade_in = out.fade_out = 0.0;
  out.velocity = velocity;
  return out;
}

inline Nanoseconds seconds(double s) {
  return fromSeconds(s);
}

inline Weights fullWeights() {
  Weights out;
  out.fill(1.0);
  return out;
}

}  // namespace vegetation_sim::forest
