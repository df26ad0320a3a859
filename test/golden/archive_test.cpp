// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of the shared scenes as bytes.
#include <gtest/gtest.h>

#include <map>

#include "scenes/catalogue.h"
#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::golden {
namespace {

using scenes::World;
constexpr int SAVED = 150, LATER = 600, EVERY = 30;  // ticks

using Parts = std::map<std::string, std::string>;

Parts save(const World& world) {
  Parts out;
  if (world.forest) out["forest"] = world.forest->forest().archived();
  if (world.grass) out["grass"] = world.grass->field().archived();
  if (world.canopy) out["canopy"] = world.canopy->canopy().archived();
  if (world.crowd) out["crowd"] = world.crowd->crowd().archived();
  return out;
}

void load(const Parts& saved, World& world) {
  for (const auto& [part, bytes] : saved) {
    if (part == "forest") {
      forest::Forest& forest = world.forest->forest();
      forest.restore(forest.readArchived(bytes));
    } else if (part == "grass") {
      grass::TreadSimulation& field = world.grass->field();
      field.restore(field.readArchived(bytes));
    } else if (part == "canopy") {
      canopy::Canopy& canopy = world.canopy->canopy();
      const canopy::Canopy::Archived read = canopy.readArchived(bytes);
      canopy.restore(read.snapshot);
      canopy.setWind(read.wind);
      canopy.setViewer(read.viewer);
    } else {
      world.crowd->crowd().restore(crowd::Crowd::readArchived(bytes));
    }
  }
}

std::map<std::string, std::uint64_t> hashes(World& world) {
  std::map<std::string, std::uint64_t> out;
  if (world.forest) out["forest"] = world.forest->forest().hash();
  if (world.grass) out["grass"] = world.grass->field().snapshot().hash();
  if (world.canopy) out["canopy"] = world.canopy->canopy().snapshot().hash();
  if (world.crowd) out["crowd"] = world.crowd->crowd().snapshot().hash();
  return out;
}

void advance(const scenes::SceneEntry& scene, World& world) {
  scene.event(world);
  world.advance();
}

void advanceTo(int tick, const scenes::SceneEntry& scene, World& world) {
  while (world.tick() < tick) advance(scene, world);
}

class Archived : public testing::TestWithParam<scenes::SceneEntry> {
 protected:
  Archived() : world_(GetParam().name) {
    GetParam().begin(world_);
    advanceTo(SAVED, GetParam(), world_);
  }
  World world_;
};

// The second world starts like another process: it gets its state from the bytes alone.
TEST_P(Archived, AStateReadInAFreshWorldContinuesWithTheSameHashes) {
  const Parts saved = save(world_);
  World other(GetParam().name, 2);
  load(saved, other);
  other.setTick(SAVED);
  EXPECT_EQ(save(other), saved) << "what is read is written again with the same bytes";
  for (int tick = SAVED; tick <= SAVED + LATER; tick += EVERY) {
    advanceTo(tick, GetParam(), world_);
    advanceTo(tick, GetParam(), other);
    ASSERT_EQ(hashes(other), hashes(world_)) << "tick " << tick;
  }
}

// Without a checksum, as if somebody had made it: it is rejected or is a state that can go on.
TEST_P(Archived, AlteredBytesAreRejectedOrAreAState) {
  const Parts saved = save(world_);
  const Random random(1);
  std::uint64_t draw = 0;
  int rejected = 0;
  for (int i = 0; i < 150; ++i) {
    Parts altered = saved;
    for (auto& [part, bytes] : altered) {
      const auto at =
          static_cast<std::size_t>(random.uniform(draw++) * static_cast<double>(bytes.size()));
      bytes[at] = static_cast<char>(256.0 * random.uniform(draw++));
      if (i % 3 == 0) bytes.resize(at);
    }
    try {
      load(altered, world_);
    } catch (const InvalidInput& error) {
      EXPECT_STRNE(error.what(), "");
      ++rejected;
    }
  }
  EXPECT_GE(rejected, 50) << "at least the truncated ones";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Archived, testing::ValuesIn(scenes::allScenes()),
                         [](const testing::TestParamInfo<scenes::SceneEntry>& info) {
                           return std::string(info.param.name);
                         });

}  // namespace
}  // namespace vegetation_sim::golden
