// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "sensors/grass/grass_volume.h"
#include "sensors/people/posed_people.h"
#include "sensors/plants/crown_field.h"
#include "sensors/plants/plant_field.h"
#include "sensors/trees/tree_field.h"

namespace vegetation_sim::scan {

/// All objects that a sensor perceives at one stamp. Rays may be cast from any thread.
struct Scene {
  Trees trees;
  Plants plants;
  Crowns crowns;  ///< of the trees, with leaves of a canopy
  GrassVolume grass;
  People people;
  std::shared_ptr<const terrain::HeightMap> ground{std::make_shared<const terrain::HeightMap>()};
};

/// Returns the nearest hit within `reach` [m], or Label::NONE: one ray, and the reference of
/// RayCaster.
Hit cast(const Scene& scene, const Ray& ray, double reach, GrassGrain grain = GrassGrain::CUBES);

/// Casts rays whose neighbours in a list are neighbours in space, such as those of adjoining beams:
/// they traverse the trees together. The hits are those of cast(). Has the memory of one
/// thread.
class RayCaster {
 public:
  RayCaster(const Scene& scene, double reach, GrassGrain grain = GrassGrain::CUBES)
      : scene_(scene), reach_(reach), grain_(grain) {}
  /// Returns the hit of each ray, until the next call.
  const std::vector<Hit>& cast(const std::vector<Ray>& rays);

 private:
  const Scene& scene_;
  double reach_;
  GrassGrain grain_;
  std::vector<FloatRay> narrow_;
  std::vector<Hit> hits_;
};
/// Returns the hit on the ground alone.
Hit castToGround(const Scene& scene, const Ray& ray, double reach);

}  // namespace vegetation_sim::scan
