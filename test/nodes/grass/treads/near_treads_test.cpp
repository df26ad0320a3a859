// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/treads/near_treads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "grass/tread_simulation.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim {
namespace {

using Use = NearTreads::Use;
constexpr double SIDE = 100.0;  // of the meadow [m]
constexpr double STROKE = 5.0;  // longest [m]

grass::MapLaw lawOfMap() {
  grass::MapLaw law;
  law.resolution = 1.0;
  law.columns = law.rows = static_cast<int>(SIDE) + 1;
  return law;
}

TreadEvent move(const std::string& source, double x, double y) {
  TreadEvent out;
  out.source = source;
  out.action = TreadEvent::MOVE;
  out.position.x = x;
  out.position.y = y;
  return out;
}

/// One of two shards, which has the tile at (50, 10) and none above y = 64.
NearTreads south() {
  return {lawOfMap(), grass::TileOwners(lawOfMap(), Shard{0, 2}),
          NearTreads::marginOf(STROKE, 0.8)};
}

TEST(NearTreads, TakesWhatIsNearAndLiftsWhatLeaves) {
  NearTreads near = south();
  EXPECT_EQ(near.useOf(move("a", 50.0, 98.0), false), Use::NONE);
  EXPECT_EQ(near.useOf(move("a", 50.0, 70.0), false), Use::ALL);  // within the margin of 30.8 m
  near.keep(move("a", 50.0, 70.0));
  EXPECT_EQ(near.useOf(move("a", 50.0, 97.0), false), Use::LIFT);
  EXPECT_EQ(near.useOf(move("a", 50.0, 98.0), false), Use::NONE);
  EXPECT_EQ(near.useOf(move("b", 50.0, 97.0), true), Use::LIFT);  // after a checkpoint
}

TEST(NearTreads, TakesLongStrokesAndWhatIsNotFinite) {
  NearTreads near = south();
  TreadEvent stroke = move("a", 50.0, 99.0);
  stroke.action = TreadEvent::STROKE;
  stroke.start.x = 50.0;
  stroke.start.y = 80.0;
  EXPECT_EQ(near.useOf(stroke, false), Use::ALL);
  near.keep(stroke);
  stroke.start.y = 98.0;
  EXPECT_EQ(near.useOf(stroke, false), Use::LIFT);  // it was there before
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(near.useOf(move("b", 50.0, nan), false), Use::ALL);  // refused by its checks
  TreadEvent unknown = move("b", 50.0, 98.0);
  unknown.action = 9;
  EXPECT_EQ(near.useOf(unknown, false), Use::ALL);  // likewise
}

TEST(NearTreads, LiftsAllIfThereAreTooManyNames) {
  NearTreads near = south();
  EXPECT_EQ(near.useOf(move("other", 50.0, 98.0), false), Use::NONE);
  for (std::size_t i = 0; i <= NearTreads::MOST_NAMES; ++i)
    near.keep(move(std::to_string(i), 50.0, 10.0));
  EXPECT_EQ(near.useOf(move("other", 50.0, 98.0), false), Use::LIFT);
}

TEST(NearTreads, OneShardTakesAll) {
  NearTreads near(lawOfMap(), grass::TileOwners(lawOfMap(), Shard()), 0.0);
  EXPECT_EQ(near.useOf(move("a", 1e9, 0.0), false), Use::ALL);
}

/// A meadow that takes the treads which its shard needs, or all.
class Ground {
 public:
  Ground(const Shard& shard, bool takes_all)
      : owners_(std::make_shared<const grass::TileOwners>(lawOfMap(), shard)),
        map_(lawOfMap(), {}, owners_),
        simulation_(layout(), std::make_shared<const terrain::HeightMap>(), {}, map_),
        near_(lawOfMap(), *owners_, NearTreads::marginOf(STROKE, 0.8)),
        takes_all_(takes_all) {}

  void take(TreadEvent event, Nanoseconds stamp) {
    const Use use =
        takes_all_ ? Use::ALL : near_.useOf(event, simulation_.sources().count(event.source) > 0);
    if (use == Use::NONE) return;
    if (use == Use::LIFT) event.action = TreadEvent::LIFT;
    if (use == Use::ALL) near_.keep(event);
    simulation_.apply(fromMsg(event, grass::TreadLaw(), 0.3), stamp);
    ++taken_;
  }
  std::uint64_t hashAt(Nanoseconds stamp) {
    simulation_.advance(stamp);
    return simulation_.update(true).hash;
  }
  int taken() const { return taken_; }

 private:
  static grass::Layout layout() {
    grass::MapInput input;
    input.law = lawOfMap();
    input.height.value = 0.3;
    input.density.value = 100.0;
    grass::Layout out;
    out.map = std::make_shared<const grass::FeatureMap>(input);
    out.terrain_hash = terrain::HeightMap().hash();
    return out;
  }

  std::shared_ptr<const grass::TileOwners> owners_;
  grass::TreadMap map_;
  grass::TreadSimulation simulation_;
  NearTreads near_;
  bool takes_all_;
  int taken_{0};
};

// Wanderers walk, jump, stand, lift and stroke all over the meadow and beside it.
TEST(NearTreads, GroundIsTheSameWithoutTheOthers) {
  for (std::uint32_t index = 0; index < 4; ++index) {
    const Shard shard{index, 4};
    Ground all(shard, true), some(shard, false);
    const Random random(7);
    double x[20], y[20];
    for (int k = 0; k < 20; ++k) x[k] = y[k] = 5.0 * k;
    for (int tick = 0; tick < 600; ++tick) {
      const Nanoseconds stamp = NANOSECONDS_PER_SECOND + tick * (NANOSECONDS_PER_SECOND / 10);
      for (int k = 0; k < 20; ++k) {
        const auto number = [&](std::uint64_t draw) {
          return random.uniform(static_cast<std::uint64_t>(20 * tick + k) * 3 + draw);
        };
        TreadEvent event = move("walker_" + std::to_string(k), x[k], y[k]);
        event.start = event.position;
        const double chance = number(0), step = chance < 0.03 ? 60.0 : chance < 0.1 ? 0.0 : 1.5;
        x[k] = std::min(SIDE + 10.0, std::max(-10.0, x[k] + step * (2.0 * number(1) - 1.0)));
        y[k] = std::min(SIDE + 10.0, std::max(-10.0, y[k] + step * (2.0 * number(2) - 1.0)));
        event.position.x = x[k];
        event.position.y = y[k];
        if (chance > 0.95) event.action = chance > 0.97 ? TreadEvent::STROKE : TreadEvent::LIFT;
        all.take(event, stamp);
        some.take(event, stamp);
      }
      if (tick % 20 != 0) continue;
      ASSERT_EQ(all.hashAt(stamp), some.hashAt(stamp)) << tick;
    }
    EXPECT_LT(some.taken(), all.taken() * 4 / 5);
    EXPECT_GT(some.taken(), all.taken() / 10);
  }
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
