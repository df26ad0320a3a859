// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/stubble.h"

#include <algorithm>

namespace vegetation_sim::canopy {
namespace {

// Returns where a line from below a height to above it meets the height, as a share of its length.
double shareBelow(double z, const Vec3& from, const Vec3& to) {
  return (z - from.z()) / (to.z() - from.z());
}

void shorten(double z, Leaf& leaf) {
  const double share = shareBelow(z, leaf.root, leaf.tip);
  leaf.tip = leaf.root + share * (leaf.tip - leaf.root);
  leaf.tip_width = leaf.root_width + static_cast<float>(share) * (leaf.tip_width - leaf.root_width);
}

// Pieces of a ribbon follow each other, each from the tip of the one before.
std::vector<FallenLeaf> cutLeaves(double z, std::vector<Leaf>& leaves) {
  std::vector<Leaf> kept;
  std::vector<FallenLeaf> fallen;
  kept.reserve(leaves.size());
  bool is_ribbon_cut = false;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    Leaf leaf = leaves[i];
    const bool continues = i > 0 && !leaf.joined && leaf.root == leaves[i - 1].tip;
    is_ribbon_cut = is_ribbon_cut && continues;
    is_ribbon_cut = is_ribbon_cut || leaf.root.z() >= z || leaf.anchor.z() > z;
    if (is_ribbon_cut) {
      if (!leaf.joined) fallen.push_back({leaf, i});
      continue;
    }
    if (leaf.tip.z() > z && !leaf.joined) {
      shorten(z, leaf);
      is_ribbon_cut = true;
    }
    kept.push_back(leaf);
  }
  leaves = std::move(kept);
  return fallen;
}

}  // namespace

std::vector<FallenLeaf> cutOff(double z, GrownPlant& plant) {
  std::vector<FallenLeaf> fallen = cutLeaves(z, plant.leaves);
  cutLeaves(z, plant.rigid);
  std::vector<Stem>& stems = plant.stems;
  stems.erase(std::remove_if(stems.begin(), stems.end(),
                             [z](const Stem& stem) { return !(stem.from.z() < z); }),
              stems.end());
  for (Stem& stem : stems)
    if (stem.to.z() > z)
      stem.to = stem.from + shareBelow(z, stem.from, stem.to) * (stem.to - stem.from);
  return fallen;
}

void checkStubble(const Stubble& stubble, std::size_t plants, const std::string& context) {
  Faults faults;
  for (const auto& [id, height] : stubble) {
    const std::string name = context + "cut of plant " + std::to_string(id);
    if (id >= plants) faults.add(name + ": there are " + std::to_string(plants) + " plants");
    const std::string fault = rangeFault(name + ": height", height, "m", CUT_HEIGHTS);
    if (!fault.empty()) faults.add(fault);
  }
  faults.throwIfAny();
}

}  // namespace vegetation_sim::canopy
