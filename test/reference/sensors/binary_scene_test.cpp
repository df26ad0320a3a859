// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/binary_scene.h"

#include <gtest/gtest.h>

#include "reference/sensors/cast_plain.h"
#include "scenes/sensors/rods_scene.h"

namespace vegetation_sim::scan {
namespace {

TEST(BoxTree, LeadsToTheNearestOfAllItems) {
  std::vector<Rod> rods = scatteredRods(500, 4.0, Vec3::Zero());
  const auto boxesOf = [&] {
    std::vector<Box> out;
    for (const Rod& rod : rods) out.push_back(boxOf(rod));
    return out;
  };
  BoxTree boxes;
  boxes.build(boxesOf());
  const Random random(5);
  for (std::size_t i = 0; i < rods.size(); ++i)  // all go elsewhere
    rods[i].base += Vec3(0.3 * random.uniform(i), 0.0, 0.1);
  boxes.refit(boxesOf());
  int hits = 0;
  std::size_t tested = 0;
  for (const Ray& ray : raysAt(rods, 500, 4.0, Vec3::Zero())) {
    Hit fast;
    boxes.visit(ray, fast, [&](std::size_t i) {
      ++tested;
      meetRod(rods, i, ray, fast);
    });
    EXPECT_TRUE(same(fast, castAtEach(rods, ray)));
    hits += fast.branch >= 0;
  }
  EXPECT_GT(hits, 100);
  EXPECT_LT(tested, 500u * 100u);  // of 500 each
}

TEST(BoxTree, OfNothingLeadsNowhere) {
  BoxTree boxes;
  boxes.build({});
  Hit nearest;
  boxes.visit(Ray(Vec3::Zero(), Vec3::UnitX()), nearest, [](std::size_t) { FAIL(); });
}

}  // namespace
}  // namespace vegetation_sim::scan
