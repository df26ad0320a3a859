// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/traversal/rod_tree_set.h"

#include <gtest/gtest.h>

#include <cmath>
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
    set.visit(ray, FloatRay(ray), out, [&](std::size_t tree, std::size_t rod, bool) {
      ++tested;
      const std::size_t i = first[tree] + rod;
      ranked.offer(i + 1, [&](Hit& hit) { return meetRod(all, i, ray, hit); });
    });
    return out;
  }

  /// Casts rays in bundles, all of which have the same reach.
  std::vector<Hit> castBundled(const std::vector<Ray>& rays, double reach,
                               std::size_t& tested) const {
    std::vector<Hit> out(rays.size());
    for (Hit& hit : out) hit.distance = reach;
    std::vector<RankedHit> ranked(out.begin(), out.end());
    const std::vector<FloatRay> narrow(rays.begin(), rays.end());
    for (std::size_t begin = 0; begin < rays.size();) {
      const int count =
          countBundled(&rays[begin], &narrow[begin], static_cast<int>(rays.size() - begin));
      const RayBundle bundle{&rays[begin], &narrow[begin], count};
      const auto fetch = [&](std::size_t tree, std::size_t rod) {
        ASSERT_LT(first[tree] + rod, all.size());
      };
      set.visit(bundle, &out[begin], fetch, [&](int i, std::size_t tree, std::size_t rod, bool) {
        ++tested;
        const std::size_t number = first[tree] + rod, ray = begin + static_cast<std::size_t>(i);
        ranked[ray].offer(number + 1,
                          [&](Hit& hit) { return meetRod(all, number, rays[ray], hit); });
      });
      begin += static_cast<std::size_t>(count);
    }
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

// Rays that look all around from places that differ by up to 1 m, neighbours after each other;
// the signs of their components change, some of them are 0, and some rays are not finite.
std::vector<Ray> raysAround(const Vec3& middle) {
  std::vector<Ray> out;
  const Random random(5);
  for (int up = -6; up <= 6; ++up)
    for (int i = 0; i < 600; ++i) {
      const SinCos around = sinCosTurns(i / 600.0), above = sinCos(0.04 * up);
      const auto n = 3 * out.size();
      const Vec3 shift(random.uniform(n, -0.5, 0.5), random.uniform(n + 1, -0.5, 0.5),
                       random.uniform(n + 2, -0.5, 0.5));
      out.emplace_back(middle + shift,
                       Vec3(above.cos * around.cos, above.cos * around.sin, above.sin));
      if (out.size() % 997 == 0) out.back().direction.x() = std::nan("");
    }
  return out;
}

// N1
TEST(RodTreeSet, RaysInBundlesHaveTheirHitsOnEveryInstructionSet) {
  const Parts parts(17);
  const std::vector<Ray> rays = raysAround(MIDDLE + Vec3(4, 6, 0));
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    for (const double reach : {4.0, 1e300}) {
      std::size_t alone = 0, bundled = 0, hits = 0;
      const std::vector<Hit> found = parts.castBundled(rays, reach, bundled);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit right = parts.cast(rays[i], reach, alone);
        EXPECT_TRUE(same(found[i], right)) << set << ", ray " << i;
        hits += right.branch >= 0;
      }
      EXPECT_GT(hits, 100U);
      EXPECT_LT(bundled, alone + alone / 4) << "a ray is tested against what others may hit";
    }
  }
  forceInstructionSet("");
}

TEST(RayBundle, HasEqualSignsSimilarDirectionsAndAtMostItsNumberOfRays) {
  const Vec3 origin = Vec3::Zero();
  const auto count = [](const std::vector<Ray>& rays) {
    const std::vector<FloatRay> narrow(rays.begin(), rays.end());
    return countBundled(rays.data(), narrow.data(), static_cast<int>(rays.size()));
  };
  const Ray forward(origin, Vec3(1, 0, 0));
  const auto turned = [&](double degrees) {
    const SinCos a = sinCosTurns(degrees / 360.0);
    return Ray(origin, Vec3(a.cos, a.sin, 0));
  };
  EXPECT_EQ(count({forward}), 1);
  EXPECT_EQ(count(std::vector<Ray>(100, forward)), RayBundle::MOST_RAYS);
  EXPECT_EQ(count({forward, turned(9.8), turned(10.2)}), 2);
  EXPECT_EQ(count({forward, turned(-1.0)}), 1) << "the sign of y differs";
  EXPECT_EQ(count({forward, Ray(origin, Vec3(1, std::nan(""), 0))}), 1);
  EXPECT_EQ(count({Ray(Vec3(std::nan(""), 0, 0), Vec3(1, 0, 0)), forward}), 1);
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

TEST(RodTreeSet, OfNoTreesOrEmptyTreesGivesNoHits) {
  std::size_t tested = 0;
  for (const int count : {0, 1}) Parts(count).cast(Ray(MIDDLE, Vec3::UnitX()), 1e300, tested);
  EXPECT_EQ(tested, 0u);
}

}  // namespace
}  // namespace vegetation_sim::scan
