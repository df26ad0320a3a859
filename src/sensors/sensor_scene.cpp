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

namespace {

// The grass comes last because it is marched through only up to the nearest hit.
void castPastTrees(const Scene& scene, const Ray& ray, const FloatRay& narrow, GrassGrain grain,
                   Hit& nearest) {
  scene.plants.meet(ray, narrow, nearest);
  scene.crowns.meet(ray, narrow, nearest);
  scene.people.meet(ray, narrow, nearest);
  if (grain == GrassGrain::BLADES)
    scene.grass.meetBlades(ray, nearest);
  else
    scene.grass.meet(ray, nearest);
}

}  // namespace

Hit cast(const Scene& scene, const Ray& ray, double reach, GrassGrain grain) {
  Hit out = castToGround(scene, ray, reach);
  const FloatRay narrow(ray);
  scene.trees.meet(ray, narrow, out);
  castPastTrees(scene, ray, narrow, grain, out);
  return out;
}

const std::vector<Hit>& RayCaster::cast(const std::vector<Ray>& rays) {
  narrow_.clear();
  hits_.clear();
  for (const Ray& ray : rays) {
    narrow_.emplace_back(ray);
    hits_.push_back(castToGround(scene_, ray, reach_));
  }
  const auto end = static_cast<int>(rays.size());
  for (int first = 0; first < end;) {
    RayBundle bundle{rays.data() + first, narrow_.data() + first, 0};
    bundle.count = countBundled(bundle.rays, bundle.narrow, end - first);
    scene_.trees.meet(bundle, hits_.data() + first);
    first += bundle.count;
  }
  for (std::size_t i = 0; i < rays.size(); ++i)
    castPastTrees(scene_, rays[i], narrow_[i], grain_, hits_[i]);
  return hits_;
}

}  // namespace vegetation_sim::scan
