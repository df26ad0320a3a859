// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Hashes of the state of a forest.
#include "forest/forest.h"
#include "tree/state/tree_hashes.h"

namespace vegetation_sim::forest {

std::uint64_t Forest::hashOf(const ForestSnapshot& snapshot) const {
  Hash out;
  out.add(layout_hash_);
  out.add(snapshot.wind.hash());
  Settings settings = snapshot.settings;
  FieldHasher hasher(out);
  describe(hasher, settings);
  snapshot.world.levels.addTo(out, snapshot.stamp, layout_.motion.transition);
  snapshot.world.modes.addTo(out);
  if (const auto& request = snapshot.world.request) {
    out.add(std::uint64_t{request->tree});
    out.add(std::uint64_t{request->fine});
    out.add(static_cast<std::uint64_t>(request->due));
  }
  snapshot.physics.addTo(out);
  return out.value();
}

std::uint64_t Forest::treesHash() const {
  TreeHashes out;
  snapshot_.world.levels.addTo(out, snapshot_.stamp, layout_.motion.transition);
  snapshot_.world.modes.addTo(out);
  if (const auto& request = snapshot_.world.request) {
    Hash& hash = out.of(request->tree, TreeHashes::REQUEST);
    hash.add(std::uint64_t{request->fine});
    hash.add(static_cast<std::uint64_t>(request->due));
  }
  snapshot_.physics.addTo(out);
  return out.sum();
}

}  // namespace vegetation_sim::forest
