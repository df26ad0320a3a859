// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/plants/posed_plant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "canopy/plants/swath.h"
#include "scenes/canopy/canopy_scene.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::scan {
namespace {

constexpr double LEAN = 0.4;  // [rad]

/// One stalk of reed, 1 m high and straight, in the middle of its plant.
canopy::Layout oneStalk() {
  canopy::Layout out = canopy::shrubScene();
  canopy::PlantKind& kind = out.kinds[0];
  kind.shape = canopy::PlantShape::REED;
  kind.leaves = 40;
  kind.radius = 0.01;
  kind.leaf_width = 0.3;
  kind.height = 1.0;
  out.plants.resize(1);
  return out;
}

/// A replica in calm air that receives cells that lean.
struct Calm {
  canopy::Canopy sender;
  canopy::Replica replica;
  explicit Calm(const canopy::Layout& layout) : sender(layout), replica(layout) { bend({}); }
  const canopy::Foliage& bend(const std::vector<canopy::BentCell>& cells) {
    sender.advance(sender.snapshot().stamp + NANOSECONDS_PER_SECOND / 30);
    canopy::StateUpdate update = sender.update(false);
    update.bent = cells;
    replica.apply(update);
    return replica.foliageOfPlane();
  }
};

std::vector<canopy::BentCell> leaning(double x) {
  return {{0, 0, static_cast<std::int16_t>(std::lround(x / canopy::LEAN_UNIT)), 0}};
}

/// Returns the range of the first hit of a ray along x at a height.
double rangeAt(const PosedPlant& plant, double height) {
  const Ray ray{Vec3(-5.0, 0.0, height), Vec3::UnitX()};
  Hit hit;
  hit.distance = 20.0;
  RankedHit nearest(hit);
  plant.meet(ray, FloatRay(ray), 1, nearest);
  return hit.distance;
}

// The law: a fibre that leans by an angle is at tan(angle) times the height, whatever its length.
TEST(PosedPlant, RangesChangeAsTheLeanSays) {
  const canopy::Layout layout = oneStalk();
  Calm calm(layout);
  PosedPlant plant(layout, 0);
  plant.pose(calm.bend({}));
  std::vector<double> upright;
  for (const double height : {0.1, 0.3, 0.5}) upright.push_back(rangeAt(plant, height));
  plant.pose(calm.bend(leaning(LEAN)));
  std::size_t i = 0;
  // Stalks lean up to 0.2 m outwards by themselves and have their feet within 1 cm.
  for (const double height : {0.1, 0.3, 0.5}) {
    EXPECT_LT(upright[i], 6.0);
    EXPECT_NEAR(rangeAt(plant, height) - upright[i++], std::tan(LEAN) * height,
                0.25 * height + 0.02);
  }
  plant.pose(calm.bend({}));
  i = 0;
  for (const double height : {0.1, 0.3, 0.5}) EXPECT_EQ(rangeAt(plant, height), upright[i++]);
}

TEST(PosedPlant, RaysPassAboveTheCut) {
  const canopy::Layout layout = oneStalk();
  const PosedPlant whole(layout, 0), cut(layout, 0, 0.4);
  EXPECT_EQ(rangeAt(cut, 0.3), rangeAt(whole, 0.3));
  EXPECT_LT(rangeAt(whole, 0.45), 6.0);
  EXPECT_EQ(rangeAt(cut, 0.45), 20.0);
  PosedPlant none(layout, 0, 0.0);
  Calm calm(layout);
  none.pose(calm.bend({}));
  EXPECT_EQ(rangeAt(none, 0.1), 20.0);
}

// Rays from above meet the straw within its layer, as foliage, and bodies that the stubble leans
// from do not move it.
TEST(PosedPlant, StrawLiesOnTheGround) {
  const canopy::Layout layout = oneStalk();
  PosedPlant cut(layout, 0, 0.0);
  Calm calm(layout);
  const double ground = layout.plants[0].position.z();
  std::vector<double> heights;
  for (const double lean : {0.0, LEAN}) {
    cut.pose(calm.bend(leaning(lean)));
    std::size_t met = 0;
    for (int i = 0; i < 400; ++i) {
      const Ray ray{Vec3(0.05 * (i % 20) - 0.5, 0.05 * (i / 20) - 0.5, ground + 5.0),
                    Vec3(0.0, 0.0, -1.0)};
      Hit hit;
      hit.distance = 5.0;
      RankedHit nearest(hit);
      cut.meet(ray, FloatRay(ray), 1, nearest);
      if (hit.distance == 5.0) continue;
      ++met;
      EXPECT_EQ(hit.label, Label::FOLIAGE);
      EXPECT_LE(5.0 - hit.distance, canopy::SWATH_HEIGHT);
      heights.push_back(5.0 - hit.distance);
    }
    EXPECT_GT(met, 100U);
  }
  const std::size_t half = heights.size() / 2;
  EXPECT_TRUE(
      std::equal(heights.begin(), heights.begin() + half, heights.begin() + half, heights.end()));
}

// Leaves turn with the fibre of their anchor, stems with those of their ends, corner by corner.
TEST(PosedPlant, LeavesAndStemsTurnAboutTheFeetOfTheirFibres) {
  const canopy::Layout layout = canopy::shrubScene();
  Calm calm(layout);
  PosedPlant plant(layout, 0), rest(layout, 0);
  std::vector<canopy::BentCell> cells;
  for (std::uint16_t cell = 0; cell < 64; ++cell) cells.push_back({0, cell, 8000, 0});
  plant.pose(calm.bend(cells));
  const double ground = layout.plants[0].position.z();
  const auto turned = [&](const Vec3& point, const Vec3& foot) {
    const Vec3 arm = point - foot;
    return Vec3(foot.x() + std::cos(LEAN) * arm.x() + std::sin(LEAN) * arm.z(), point.y(),
                foot.z() + std::cos(LEAN) * arm.z() - std::sin(LEAN) * arm.x());
  };
  const auto footOf = [&](const Vec3& anchor) { return Vec3(anchor.x(), anchor.y(), ground); };
  const canopy::GrownPlant grown = canopy::grow(layout.kinds[0], layout.plants[0]);
  ASSERT_GT(plant.stems().size(), 4u);
  for (std::size_t i = 0; i < grown.leaves.size(); ++i) {
    const canopy::Leaf& leaf = grown.leaves[i];
    const Vec3 tip = turned(leaf.tip, footOf(leaf.anchor));
    EXPECT_LT(length(Vec3(plant.strips()[i].tip - tip)), 1e-12);
  }
  for (std::size_t i = 0; i < grown.stems.size(); ++i) {
    const canopy::Stem& stem = grown.stems[i];
    const Rod expected = rodBetween(turned(stem.from, footOf(stem.from)),
                                    turned(stem.to, footOf(stem.to)), 0.0, 0.0);
    EXPECT_LT(length(Vec3(plant.stems()[i].base - expected.base)), 1e-12);
    EXPECT_LT(length(Vec3(plant.stems()[i].axis - expected.axis)), 1e-12);
    EXPECT_GT(length(Vec3(plant.stems()[i].axis - rest.stems()[i].axis)), 0.05);
  }
}

}  // namespace
}  // namespace vegetation_sim::scan
