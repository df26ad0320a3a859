// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/tree_requests.h"

#include <algorithm>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double SHORTEST_DIRECTION = 1e-9;
constexpr int LARGEST_PAGE = 100;  // trees; each of them is grown for its height

}  // namespace

forest::Ray rayOf(const Pick::Request& request) {
  const auto& o = request.origin;
  const auto& d = request.direction;
  forest::Ray ray{Vec3(o.x, o.y, o.z), Vec3(d.x, d.y, d.z), request.tolerance};
  Faults faults;
  FieldChecker checker("", faults);
  checker.vector("origin", ray.origin, "m", {-1e7, 1e7});
  checker.vector("direction", ray.direction, "", {-1e6, 1e6});
  checker.number("tolerance", ray.tolerance, "m", {0.0, 10.0});
  if (faults.empty() && length(ray.direction) < SHORTEST_DIRECTION)
    faults.add("direction has no length; allowed is 1e-9 or more");
  faults.throwIfAny();
  return ray;
}

void check(const FindTrees::Request& request) {
  Vec3 centre = fromMsg(request.centre.point);
  double radius = request.radius;
  int limit = static_cast<int>(std::min(request.limit, std::uint32_t{INT32_MAX}));
  Faults faults;
  FieldChecker checker("", faults);
  checker.integer("limit", limit, "", {1, LARGEST_PAGE});
  if (!request.all) {
    checker.vector("centre", centre, "m", {-1e7, 1e7});
    checker.number("radius", radius, "m", {0.0, 1e7});
  }
  faults.throwIfAny();
}

}  // namespace vegetation_sim
