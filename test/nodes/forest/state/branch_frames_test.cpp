// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/frames/branch_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "scenes/forest/physics_scene.h"

namespace vegetation_sim {
namespace {

using Key = std::pair<std::uint32_t, std::uint32_t>;

/// Two of four oaks move: twigs of the first one are touched, and one branch of the last one is
/// pulled hard.
struct Pulled {
  Pulled() : rig({}, 2) {
    for (int i = 0; i < 6; ++i) rig.touch(rig.twig() - i, 60.0);
    const forest::Tree last = growTree(rig.forest.layout(), 3, rig.forest.terrain());
    forest::Push push;
    push.point = {3, last.skeleton.depth_end[1] - 1, 0.5};
    push.force = Vec3(0.0, 60.0, 0.0);
    push.until = rig.now() + forest::seconds(60.0);
    rig.forest.push(push);
    rig.run(1.0);
  }
  std::set<Key> choose(BranchFrames& frames) {
    std::set<Key> out;
    PosedTrees trees(rig.forest, cache, rig.now());
    for (const auto& [tree, branches] : frames.withPhysical(trees, held))
      for (const std::uint32_t branch : branches) out.insert({tree, branch});
    return out;
  }
  std::size_t physical(std::uint32_t tree) const {
    return rig.forest.promoted(tree).branches.size();
  }
  forest::PhysicsRig rig;
  forest::TreeCache cache{100000};
  std::vector<forest::BranchPoint> held;
};

// N7: frames go to the branches that are farthest from rest, whatever the ids of their trees.
TEST(BranchFrames, GoToTheBranchesThatAreFarthestFromRest) {
  Pulled scene;
  const auto first = scene.physical(0), last = scene.physical(3);
  ASSERT_GT(first, 1u);
  ASSERT_GT(last, 1u);
  BranchFrames all(1000), few(static_cast<int>(last));
  EXPECT_EQ(scene.choose(all).size(), first + last);
  EXPECT_EQ(all.balance().held_back, 0u);
  const std::set<Key> chosen = scene.choose(few);
  EXPECT_EQ(chosen.size(), last);
  for (const Key& key : chosen) EXPECT_EQ(key.first, 3u);
  EXPECT_EQ(few.balance().held_back, first);
}

// A held branch has a frame, and requested frames have priority over other physical branches.
TEST(BranchFrames, GoToHeldAndRequestedBranchesFirst) {
  Pulled scene;
  scene.held = {{1, 5, 0.0}};
  BranchFrames frames(3);
  EXPECT_EQ(scene.choose(frames).count({1, 5}), 1u);
  frames.set(2, {7, 8}, 100, true);  // The earlier frames are still in their cool-down.
  EXPECT_EQ(scene.choose(frames), (std::set<Key>{{1, 5}, {2, 7}, {2, 8}}));
  frames.set(2, {9}, 100, true);
  EXPECT_EQ(scene.choose(frames), (std::set<Key>{{2, 7}, {2, 8}, {2, 9}}));
}

// N7: this also holds during the cool-down of other frames. The error of a branch without a frame
// is reported in metres if any frame remains to be shared.
TEST(BranchFrames, GoAtOnceToBranchesThatAreGrabbed) {
  Pulled scene;
  const std::size_t physical = scene.physical(0) + scene.physical(3);
  BranchFrames frames(3);
  EXPECT_EQ(scene.choose(frames).size(), 3u);  // All frames are in use.
  scene.held = {{1, 5, 0.0}};
  const std::set<Key> chosen = scene.choose(frames);
  EXPECT_EQ(chosen.size(), 3u);
  EXPECT_EQ(chosen.count({1, 5}), 1u);
  EXPECT_EQ(frames.balance().held_back, physical - 2);
  EXPECT_GT(frames.balance().largest, 0.0);
  EXPECT_LT(frames.balance().largest, 10.0);
  scene.held = {{1, 5, 0.0}, {1, 6, 0.0}, {1, 7, 0.0}, {1, 8, 0.0}};
  EXPECT_EQ(scene.choose(frames), (std::set<Key>{{1, 5}, {1, 6}, {1, 7}}));
  EXPECT_EQ(frames.balance().held_back, physical + 1);
  EXPECT_TRUE(std::isnan(frames.balance().largest));
}

// N7: branches oscillate through their rest pose, and still no frame appears and disappears within
// a second.
TEST(BranchFrames, DoNotFlicker) {
  Pulled scene;
  scene.rig.forest.setWind(forest::steadyWind(Vec3(8.0, 0.0, 0.0), 6.0));
  BranchFrames frames(4);
  std::map<Key, Nanoseconds> since;
  for (const Key& key : scene.choose(frames)) since[key] = scene.rig.now();
  scene.rig.run(4.0, [&] {
    const std::set<Key> chosen = scene.choose(frames);
    EXPECT_EQ(chosen.size(), 4u);
    for (auto entry = since.begin(); entry != since.end();) {
      if (chosen.count(entry->first)) {
        ++entry;
        continue;
      }
      EXPECT_GE(secondsBetween(entry->second, scene.rig.now()), TIER_HOLD);
      entry = since.erase(entry);
    }
    for (const Key& key : chosen) since.emplace(key, scene.rig.now());
  });
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
