// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/geometry/rod_tree_set.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "scenes/sensors/rods_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::scan {
namespace {

const Vec3 MIDDLE(1234.5, -876.25, 40.0);

/// Rods in parts, each in a tree of its own; part i has 0, 1, 9, 65 or 500 rods.
struct Parts {
  explicit Parts(int count) {
    constexpr int SIZES[] = {0, 1, 9, 65, 500};
    for (int i = 0; i < count; ++i) {
      const Vec3 centre = MIDDLE + Vec3(3.0 * (i % 4), 3.0 * (i / 4), 0.3 * i);
      const std::vector<Rod> rods = scatteredRods(SIZES[i % 5], 5.0, centre, std::uint64_t(i) + 1);
      first.push_back(all.size());
      all.insert(all.end(), rods.begin(), rods.end());
      trees.emplace_back();
      trees.back().build(rods, std::vector<double>(rods.size(), 0.0), MIDDLE);
    }
    std::vector<const RodTree*> pointers;
    for (const RodTree& tree : trees) pointers.push_back(&tree);
    ThreadPool threads(3);
    set.set(pointers, MIDDLE, threads);
  }
  Hit cast(const Ray& ray, double reach, std::size_t& tested) const {
    Hit out;
    out.distance = reach;
    RankedHit ranked(out);
    set.visit(ray, FloatRay(ray), out, [&](std::size_t tree, std::size_t rod) {
      ++tested;
      const std::size_t i = first[tree] + rod;
      ranked.offer(i + 1, [&](Hit& hit) { return meetRod(all, i, ray, hit); });
    });
    return out;
  }

  std::vector<Rod> all;
  std::vector<std::size_t> first;  ///< of the rods of each part in `all`
  std::vector<RodTree> trees;
  RodTreeSet set;
};

// N1
TEST(RodTreeSet, GivesTheHitsOfATestOfEveryRodOnEveryInstructionSet) {
  const Parts parts(17);
  const std::vector<Ray> rays = raysAt(parts.all, 400, 20.0, MIDDLE + Vec3(4, 6, 0));
  std::size_t tested = 0, hits = 0;
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    for (const Ray& ray : rays)
      for (const double reach : {4.0, 1e300}) {
        const Hit hit = parts.cast(ray, reach, tested), right = castAtEach(parts.all, ray, reach);
        EXPECT_TRUE(same(hit, right)) << set << ": " << hit.branch << " for " << right.branch;
        hits += right.branch >= 0;
      }
  }
  forceInstructionSet("");
  const std::size_t casts = 2 * rays.size() * instructionSets().size();
  EXPECT_GT(hits, casts / 5);
  EXPECT_LT(tested, casts * parts.all.size() / 50);
}

// Rounded down, a radius would keep rays from rods that they hit.
TEST(RodTreeSet, RoundsRadiiUp) {
  for (const float radius : {1e-6f, 0.01f, 0.5f, 1.f, 3.14159f}) {
    const std::uint32_t bits = std::uint32_t{roundUp(radius)} << 16;
    float back = 0.f;
    std::memcpy(&back, &bits, sizeof back);
    EXPECT_GE(back, radius);
    EXPECT_LE(back, radius * (1.f + 0x1p-7f));
  }
}

TEST(RodTreeSet, OfNoTreesOrEmptyTreesLeadsNowhere) {
  std::size_t tested = 0;
  for (const int count : {0, 1}) Parts(count).cast(Ray(MIDDLE, Vec3::UnitX()), 1e300, tested);
  EXPECT_EQ(tested, 0u);
}

}  // namespace
}  // namespace vegetation_sim::scan
