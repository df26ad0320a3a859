// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "forest/detail/tree_regions.h"
#include "tree/lod/level_table.h"
#include "tree/shards/tree_owners.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::forest {

/// Errors of the models of all trees of a layout, measured per species and size, and the regions in
/// which the trees of a shard stand.
class TreeErrors {
 public:
  /// Measures all trees, and lists the regions of those that the shard of `owners` owns.
  void measure(const Layout& layout, const terrain::HeightMap& terrain, const TreeOwners& owners);
  /// Computes the response errors of all species now, some 30 ms for each of a few sizes, instead
  /// of at the first tick with a listener nearby.
  void precompute(const Layout& layout);

  const TreeRegions& regions() const { return regions_; }
  LevelTable tableOf(const TreeSeed& seed) const { return tables_[seed.species].at(seed.scale); }
  PredictedError responseErrorOf(const Layout& layout, const TreeSeed& seed,
                                 const wind::GustSpectrum& spectrum);
  /// Error of any tree with all joints fixed [m per m/s].
  double largestOmission() const { return largest_omission_; }
  double slowestReference() const { return slowest_reference_; }  ///< speed, of any species [m/s]

 private:
  void measureSpecies(const Layout& layout, std::size_t species, double scale);

  std::vector<LevelScales> tables_;  // per species
  double extent_{0.0};               // height plus reach of the largest tree [m]
  double largest_omission_{0.0};
  double slowest_reference_{1.0};
  TreeRegions regions_;
};

}  // namespace vegetation_sim::forest
