// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/shading.h"

#include "sensors/camera/texture.h"
#include "sensors/sky_view.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

constexpr double OFFSET = 1e-3;       // of rays of light from their surface [m]
constexpr double FARTHEST = 20000.0;  // ground that is seen beyond the range [m]
constexpr double DARK = 5.0;          // optical depth that leaves 0.7 % of the light
constexpr double OPEN_SPOT = 0.02;    // places that look at one part of the sky [m]
constexpr std::uint32_t OPEN_KEY = 0x6f70656eU;

}  // namespace

Vec3 Shading::radiance(const Ray& ray, const Hit& hit) const {
  if (hit.label == Label::NONE) return beyond(ray);
  const Vec3 place = ray.at(hit.distance);
  const bool sheltered = hit.label == Label::GROUND && camera_.shadows != Shadows::NONE;
  const Surface surface = sheltered ? groundAt(place) : surfaces_.at(ray, hit);
  return light_.through(lit(place, surface), hit.distance);
}

Surface Shading::groundAt(const Vec3& place) const {
  const double open = openness(place);
  Surface out = surfaces_.groundAt(place, open);
  out.sky = 0.25 + 0.75 * open;
  return out;
}

// Ground beyond the range is a plane; the rest is sky.
Vec3 Shading::beyond(const Ray& ray) const {
  const Vec3 end = ray.at(camera_.range_max);
  const double above = end.z() - scene_.ground->height(end.x(), end.y());
  if (!(ray.direction.z() < 0.0 && above > 0.0)) return light_.skyTowards(ray.direction);
  const double distance = camera_.range_max - above / ray.direction.z();
  if (distance > FARTHEST) return light_.through(light_.skyTowards(ray.direction), FARTHEST);
  Surface ground = surfaces_.groundAt(ray.at(distance));
  return light_.through(
      ground.albedo.cwiseProduct(light_.sun() * light_.toSun().z() + light_.ambient(1.0, 1.0)),
      distance);
}

// Returns the share of the sky at a place of the ground, from one direction per spot.
double Shading::openness(const Vec3& place) const {
  const Vec3 way = randomVector(cellAt(place, OPEN_SPOT), OPEN_KEY) + Vec3(0.0, 0.0, 1.6);
  const Vec3 from = place + Vec3(0.0, 0.0, OFFSET);
  return transmittance(scene_, Ray(from, way / length(way)), camera_.range_max, DARK);
}

// Returns the share of sunlight that reaches a place.
double Shading::sunAt(const Vec3& place) const {
  const Ray ray(place, light_.toSun());
  Hit solid = castToGround(scene_, ray, camera_.range_max);
  const FloatRay narrow(ray);
  scene_.people.meet(ray, narrow, solid);
  scene_.plants.meet(ray, narrow, solid);
  scene_.crowns.meet(ray, narrow, solid);
  if (solid.label != Label::NONE) return 0.0;
  LightPath path(camera_.range_max, DARK);
  scene_.trees.addDepth(ray, narrow, path);
  if (scene_.grass.isPresent()) path.add(scene_.grass.depthAbove(place, light_.toSun()));
  return path.transmittance();
}

Vec3 Shading::lit(const Vec3& place, const Surface& surface) const {
  const double facing = dot(surface.normal, light_.toSun());
  double direct = facing > 0.0 ? facing : -facing * surface.transmits;
  if (direct > 0.0 && camera_.shadows != Shadows::NONE) {
    const Vec3 from = place + (facing > 0.0 ? OFFSET : -OFFSET) * surface.normal;
    direct *= sunAt(from);
  }
  return surface.albedo.cwiseProduct(direct * light_.sun() +
                                     light_.ambient(surface.normal.z(), surface.sky));
}

}  // namespace vegetation_sim::scan
