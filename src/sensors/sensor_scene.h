// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "sensors/grass/grass_volume.h"
#include "sensors/people.h"
#include "sensors/plants/plant_field.h"
#include "sensors/tree_field.h"

namespace vegetation_sim::scan {

/// All objects that a sensor perceives at one stamp. Rays may be cast from any thread.
struct Scene {
  Trees trees;
  Plants plants;
  GrassVolume grass;
  People people;
  std::shared_ptr<const terrain::HeightMap> ground{std::make_shared<const terrain::HeightMap>()};
};

/// Returns the nearest hit within `reach` [m], or Label::NONE.
Hit cast(const Scene& scene, const Ray& ray, double reach, GrassGrain grain = GrassGrain::CUBES);
/// Returns the hit on the ground alone.
Hit castToGround(const Scene& scene, const Ray& ray, double reach);

}  // namespace vegetation_sim::scan
