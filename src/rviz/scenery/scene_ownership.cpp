// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/scene_ownership.h"

#include <algorithm>
#include <vector>

namespace vegetation_sim::view {
namespace {

// The oldest is first.
std::vector<const SceneOwnership*>& allOwnerships() {
  static std::vector<const SceneOwnership*> ownerships;
  return ownerships;
}

}  // namespace

SceneOwnership::SceneOwnership(const Ogre::SceneManager& scene, Shared thing, std::uint64_t key,
                               int rank, const rviz::Display& display)
    : scene_(scene), thing_(thing), key_(key), rank_(rank), display_(display) {
  allOwnerships().push_back(this);
}

SceneOwnership::~SceneOwnership() {
  std::vector<const SceneOwnership*>& all = allOwnerships();
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
}

const SceneOwnership& SceneOwnership::holder() const {
  const SceneOwnership* best = nullptr;
  for (const SceneOwnership* other : allOwnerships()) {
    if (&other->scene_ != &scene_ || other->thing_ != thing_ || other->key_ != key_) continue;
    if (best == nullptr || other->rank_ > best->rank_) best = other;
  }
  return *best;
}

}  // namespace vegetation_sim::view
