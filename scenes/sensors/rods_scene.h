// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "scenes/sensors/lidar_scene.h"
#include "sensors/geometry/ranked_hit.h"
#include "sensors/traversal/rod_tree.h"

namespace vegetation_sim::scan {

/// Returns `count` rods of many sizes in a cube of edge `size` around a place.
inline std::vector<Rod> scatteredRods(int count, double size, const Vec3& centre,
                                      std::uint64_t seed = 5) {
  const Random random(seed);
  std::vector<Rod> out;
  for (int i = 0; i < count; ++i) {
    const auto k = 10 * static_cast<std::uint64_t>(i);
    const Vec3 base =
        centre + size * Vec3(random.uniform(k, -0.5, 0.5), random.uniform(k + 1, -0.5, 0.5),
                             random.uniform(k + 2, -0.5, 0.5));
    const double length = 0.3 * size * random.uniform(k + 3) * random.uniform(k + 4);
    const double radius = 0.001 + 0.02 * length * random.uniform(k + 5);
    out.push_back(rodBetween(base, base + length * randomDirection(random, k + 6, -1.5, 1.5),
                             radius, radius * random.uniform(k + 8, 0.3, 1.0)));
  }
  return out;
}

/// Rays from within and around a cube of edge `size`: to any side, along the axes of the world,
/// and along and from within the rods.
inline std::vector<Ray> raysAt(const std::vector<Rod>& rods, int count, double size,
                               const Vec3& centre, std::uint64_t seed = 6) {
  const Random random(seed);
  std::vector<Ray> out;
  for (int i = 0; i < count; ++i) {
    const auto k = 10 * static_cast<std::uint64_t>(i);
    Vec3 from = centre + size * Vec3(random.uniform(k, -1.0, 1.0), random.uniform(k + 1, -1.0, 1.0),
                                     random.uniform(k + 2, -1.0, 1.0));
    const Rod& rod = rods[random.bits(k + 3) % rods.size()];
    const Vec3 aim = rod.base + random.uniform(k + 4) * rod.length * rod.axis;
    if (i % 5 == 0) from = aim;  // starts inside
    switch (i % 4) {
      case 0:  // to a rod
        out.emplace_back(from, i % 5 == 0 ? randomDirection(random, k + 7, -1.5, 1.5)
                                          : Vec3((aim - from).normalized()));
        break;
      case 1: {  // along an axis of the world, through a rod
        const int axis = i / 4 % 3;
        Vec3 direction = Vec3::Zero();
        direction[axis] = i / 12 % 2 == 0 ? 1.0 : -1.0;
        out.emplace_back(aim - (i % 5 == 0 ? 0.0 : size) * direction, direction);
        break;
      }
      case 2:  // along the axis of a rod
        out.emplace_back(rod.base - size * rod.axis, rod.axis);
        break;
      default:
        out.emplace_back(from, randomDirection(random, k + 7, -1.5, 1.5));
    }
  }
  return out;
}

/// Replaces the hit by a nearer one on a rod, whose index becomes its branch.
inline bool meetRod(const std::vector<Rod>& rods, std::size_t i, const Ray& ray, Hit& nearest) {
  Meeting meeting;
  if (!meet(ray, rods[i], nearest.distance, meeting)) return false;
  nearest = {meeting.distance, Label::BRANCH, 0, static_cast<int>(i), meeting.cosine};
  return true;
}

/// Returns the hit of a test of every rod.
inline Hit castAtEach(const std::vector<Rod>& rods, const Ray& ray, double reach = Box::ENDLESS) {
  Hit out;
  out.distance = reach;
  for (std::size_t i = 0; i < rods.size(); ++i) meetRod(rods, i, ray, out);
  return out;
}

/// Returns the hit that the tree leads to. @param tested is increased by the number of rods tested.
inline Hit castInto(const RodTree& tree, const std::vector<Rod>& rods, const Ray& ray,
                    std::size_t& tested, double reach = Box::ENDLESS) {
  Hit out;
  out.distance = reach;
  RankedHit ranked(out);
  tree.visit(ray, FloatRay(ray), out, [&](std::size_t i) {
    ++tested;
    ranked.offer(i + 1, [&](Hit& hit) { return meetRod(rods, i, ray, hit); });
  });
  return out;
}

}  // namespace vegetation_sim::scan
