// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/meadow_replica.h"

#include "ros/params/resources.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double MEMORY_CAP = 1e9;  // [bytes] of trodden ground

}  // namespace

MeadowReplica::MeadowReplica(const GrassLayout& message)
    : layout(fromMsg(message)), hash(layout.hash()), terrain(loadTerrain(layout.terrain)) {
  if (terrain->hash() != layout.terrain_hash)
    throw InvalidInput("layout: terrain = '" + layout.terrain +
                       "' has other heights here than where it was made");
  grass::TreadSettings settings;
  settings.spacing = layout.tread_spacing;
  settings.memory_cap = MEMORY_CAP;
  tread = std::make_unique<grass::TreadMap>(layout.map->law(), settings);
}

bool MeadowReplica::forgetLater(Nanoseconds now) {
  if (!ready() || replica.stamp() <= now) return false;
  tread->clear();
  replica.reset();
  return true;
}

}  // namespace vegetation_sim
