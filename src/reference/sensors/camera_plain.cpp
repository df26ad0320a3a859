// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/camera_plain.h"

#include <cmath>

#include "reference/sensors/cast_plain.h"
#include "sensors/media/beer_lambert.h"

namespace vegetation_sim::scan {
namespace {

constexpr double GROUND_STEP = 0.02;  // [m]; the ground is smooth

double heightAt(const Scene& scene, const Vec3& place) {
  return place.z() - scene.ground->height(place.x(), place.y());
}

void meetGroundInSteps(const Scene& scene, const Ray& ray, Hit& nearest) {
  double from = 0.0;
  while (from < nearest.distance && heightAt(scene, ray.at(from + GROUND_STEP)) > 0.0)
    from += GROUND_STEP;
  double to = from + GROUND_STEP;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (from + to);
    (heightAt(scene, ray.at(middle)) > 0.0 ? from : to) = middle;
  }
  if (to < nearest.distance) nearest = {to, Label::GROUND, 0, -1, 1.0};
}

// The part of the medium at a place, and its random number.
struct Grain {
  Cell cell;
  double size{0.0};
  std::uint32_t key{0};
  bool operator==(const Grain& other) const {
    return size == other.size && cell.x == other.cell.x && cell.y == other.cell.y &&
           cell.z == other.cell.z;
  }
};

Grain grainAt(const Scene& scene, const Vec3& place, double distance) {
  const auto seed = static_cast<std::uint32_t>(scene.grass.layout().seed);
  for (const BladeColumns& form : BLADE_COLUMNS)
    if (distance < form.reach) {
      Cell column = cellAt(place, form.width);
      column.z = 0;
      return {column, form.width, seed ^ BLADE_SEED};
    }
  return {cellAt(place, GRASS_CELL), GRASS_CELL, seed};
}

// A grain stops the ray once the optical depth within it exceeds that of its random number.
void meetGrassInSteps(const Scene& scene, const Ray& ray, Hit& nearest) {
  if (!scene.grass.isPresent()) return;
  const double tallest = scene.grass.layout().map->tallest();
  Grain grain;
  double depth = 0.0;
  for (double from = 0.0; from < nearest.distance; from += PLAIN_STEP) {
    const Vec3 place = ray.at(from + 0.5 * PLAIN_STEP);
    const double height = heightAt(scene, place);
    if (height > tallest + 0.05) {  // The ground is not steeper than 45 degrees.
      from += 0.3 * (height - tallest);
      continue;
    }
    const Grain here = grainAt(scene, place, from);
    if (!(here == grain)) depth = 0.0;
    grain = here;
    depth += PLAIN_STEP * scene.grass.extinction(place, ray.direction);
    if (depth < depthAt(shareOf(grain.cell, grain.key))) continue;
    nearest = {from, Label::GRASS, 0, -1, BLADE_COSINE};
    return;
  }
}

}  // namespace

Hit castCameraPlain(const Scene& scene, const Ray& ray, double reach) {
  Hit out;
  out.distance = reach;
  meetGroundInSteps(scene, ray, out);
  meetEachBranch(scene.trees, ray, out);
  meetEachPlant(scene.plants, ray, out);
  for (std::size_t i = 0; i < scene.people.limbs(); ++i) scene.people.meetLimb(i, ray, out);
  meetGrassInSteps(scene, ray, out);
  return out;
}

}  // namespace vegetation_sim::scan
