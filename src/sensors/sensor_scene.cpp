// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sensor_scene.h"

#include "terrain/ground_ray.h"

namespace vegetation_sim::scan {

Hit castToGround(const Scene& scene, const Ray& ray, double reach) {
  Hit out;
  out.distance = reach;
  Vec3 place;
  if (!terrain::meetGround(*scene.ground, ray.origin, ray.direction, reach, place)) return out;
  const double distance = length(place - ray.origin);
  if (!(distance < reach)) return out;
  const double cosine = std::fabs(dot(scene.ground->normal(place.x(), place.y()), ray.direction));
  return {distance, Label::GROUND, 0, -1, cosine};
}

// The grass comes last because it is marched through only up to the nearest hit.
Hit cast(const Scene& scene, const Ray& ray, double reach, GrassGrain grain) {
  Hit out = castToGround(scene, ray, reach);
  const FloatRay narrow(ray);
  scene.trees.meet(ray, narrow, out);
  scene.plants.meet(ray, narrow, out);
  scene.people.meet(ray, narrow, out);
  if (grain == GrassGrain::BLADES)
    scene.grass.meetBlades(ray, out);
  else
    scene.grass.meet(ray, out);
  return out;
}

}  // namespace vegetation_sim::scan
