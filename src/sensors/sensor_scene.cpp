// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/sensor_scene.h"

#include "terrain/ground_ray.h"

namespace vegetation_sim::scan {
namespace {

void meetEarth(const terrain::HeightMap& ground, const Ray& ray, Hit& nearest) {
  Vec3 place;
  if (!terrain::meetGround(ground, ray.origin, ray.direction, nearest.distance, place)) return;
  const double distance = length(place - ray.origin);
  if (!(distance < nearest.distance)) return;
  const double cosine = std::fabs(dot(ground.normal(place.x(), place.y()), ray.direction));
  nearest = {distance, Label::GROUND, 0, -1, cosine};
}

Hit nothingWithin(double reach) {
  Hit out;
  out.distance = reach;
  return out;
}

}  // namespace

// Grass last: only what of the ray is left is marched through.
Hit cast(const Scene& scene, const Ray& ray, double reach) {
  Hit out = nothingWithin(reach);
  meetEarth(*scene.ground, ray, out);
  scene.trees.meet(ray, out);
  scene.people.meet(ray, out);
  scene.grass.meet(ray, out);
  return out;
}

Hit castPlain(const Scene& scene, const Ray& ray, double reach) {
  Hit out = nothingWithin(reach);
  meetEarth(*scene.ground, ray, out);
  scene.trees.meetEach(ray, out);
  scene.people.meetEach(ray, out);
  scene.grass.meet(ray, out);
  return out;
}

}  // namespace vegetation_sim::scan
