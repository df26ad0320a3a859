// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/scene_claim.h"

#include <algorithm>
#include <vector>

namespace vegetation_sim::view {
namespace {

// Oldest first.
std::vector<const Claim*>& allClaims() {
  static std::vector<const Claim*> claims;
  return claims;
}

}  // namespace

Claim::Claim(const Ogre::SceneManager& scene, Shared thing, std::uint64_t key, int rank,
             const rviz::Display& display)
    : scene_(scene), thing_(thing), key_(key), rank_(rank), display_(display) {
  allClaims().push_back(this);
}

Claim::~Claim() {
  std::vector<const Claim*>& all = allClaims();
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
}

const Claim& Claim::holder() const {
  const Claim* best = nullptr;
  for (const Claim* other : allClaims()) {
    if (&other->scene_ != &scene_ || other->thing_ != thing_ || other->key_ != key_) continue;
    if (best == nullptr || other->rank_ > best->rank_) best = other;
  }
  return *best;
}

}  // namespace vegetation_sim::view
