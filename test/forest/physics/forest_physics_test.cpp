// Memory of a million trees and of physics, counted at the allocator.
#include <gtest/gtest.h>

#include "heap.h"
#include "scenes/forest/forest_fixture.h"
#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

constexpr Nanoseconds START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr long MOST_PER_TREE = 200;  // permanently, per tree [byte]
constexpr long TREES = 1000000;

Layout millionTrees() {
  Layout out = gridLayout(1, 1.0);
  out.trees.clear();
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Tile tile;
    tile.first_tree = i * 1000;
    tile.count = 1000;
    tile.seed = i;
    tile.x = 200.0 * (i % 32);
    tile.y = 200.0 * (i / 32);
    tile.size = 200.0;
    tile.mix = {1.f, 1.f, 1.f, 1.f};
    out.tiles.push_back(tile);
  }
  return out;
}

// A million trees in tiles: no memory per tree without viewers, and little even if each has its own
// level.
TEST(Memory, MillionTreesStayWithinTheirBytes) {
  const long before = liveBytes();
  Settings settings;
  settings.budget.frame_time = 1e6;  // no limit
  Forest forest(millionTrees(), flatTerrain(), settings);
  ASSERT_EQ(forest.layout().treeCount(), static_cast<std::uint32_t>(TREES));
  forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 0, 0))}));
  forest.advance(START);
  const long unwatched = liveBytes() - before;
  EXPECT_LT(unwatched, TREES);  // less than a byte each
  Viewpoint eye;
  eye.position = Vec3(3000, 3000, 100);
  eye.pixels_per_radian = 1e6;  // every twig of the farthest tree is visible
  forest.setViewers({eye});
  forest.advance(START + 20 * NANOSECONDS_PER_SECOND);  // time in which all levels may change
  ASSERT_EQ(forest.view().levels.held().size(), static_cast<std::size_t>(TREES));
  forest.updateView(false);
  const long watched = liveBytes() - before;
  EXPECT_GT(watched, 40 * TREES);  // otherwise nothing was counted
  EXPECT_LT(watched, MOST_PER_TREE * TREES);
  RecordProperty("bytes_unwatched", std::to_string(unwatched));
  std::printf("a million trees: %ld bytes unwatched, %.1f bytes a tree with all of them held\n",
              unwatched, static_cast<double>(watched) / TREES);
}

// S1-25, N12: of 256 trees in wind, a grab makes branches of one tree physical; after release and
// blend all its memory is freed.
TEST(Memory, OneGrabIn256TreesGivesAllBack) {
  PhysicsRig rig({}, 16);
  ASSERT_EQ(rig.forest.layout().treeCount(), 256u);
  rig.forest.setWind(steadyWind(Vec3(2, 1, 0)));
  rig.run(1.0);
  rig.forest.update(true), rig.forest.updateView(true);
  const long before = liveBytes();
  EXPECT_EQ(rig.forest.physicsFigures().bytes, 0u);
  Grab grab = rig.grabOf(rig.branchOfDepth(1));
  grab.target += Vec3(0.3, 0.0, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(1.0);
  const PhysicsFigures during = rig.forest.physicsFigures();
  const long held = liveBytes() - before;
  EXPECT_EQ(during.trees, 1u);
  EXPECT_GT(during.branches, 1u);
  EXPECT_LT(during.branches, rig.branches().size() / 2);
  // The reported bytes are those held, except for scratch memory of the steps.
  EXPECT_LE(static_cast<long>(during.bytes), held);
  EXPECT_GT(2 * static_cast<long>(during.bytes), held);
  rig.forest.release(id);
  rig.run(1.0);
  EXPECT_GT(rig.forest.physicsFigures().branches, 0u);  // recoils
  for (int i = 0; i < 20 && rig.forest.physicsFigures().trees > 0; ++i) rig.run(1.0);
  const PhysicsFigures after = rig.forest.physicsFigures();
  rig.forest.update(true), rig.forest.updateView(true);
  const long left = liveBytes() - before;
  EXPECT_EQ(after.trees + after.branches + after.bytes, 0u);
  EXPECT_LE(left, 0);
  std::printf("256 trees, one grab: %zu branches, %zu bytes published, %ld held, %ld after\n",
              during.branches, during.bytes, held, left);
}

struct Held {
  std::size_t branches, reported, archived;
  long live;
};

// Returns what a tree with all branches down to a depth physical holds.
Held holdDepth(int depth) {
  PhysicsSettings settings;
  settings.promotion = Promotion::DEPTH;
  PhysicsRig rig(settings);
  const auto archived = static_cast<long>(rig.forest.archived().size());
  const long before = liveBytes();
  rig.touch(rig.branchOfDepth(depth), 10.0);
  rig.run(1.0);
  const PhysicsFigures figures = rig.forest.physicsFigures();
  const long live = liveBytes() - before;
  return {figures.branches, figures.bytes, rig.forest.archived().size() - archived, live};
}

// S1-34: what one more physical branch costs. The rest of what a touched tree holds is its grown
// tree and the scratch memory of steps, which do not depend on the number of physical branches.
TEST(Memory, APhysicalBranchHasItsStatedBytes) {
  const Held few = holdDepth(1), many = holdDepth(PhysicsRig().tree.skeleton.depths() - 1);
  ASSERT_GT(many.branches, few.branches + 100);
  const auto more = static_cast<double>(many.branches - few.branches);
  const double reported = static_cast<double>(many.reported - few.reported) / more;
  const double live = static_cast<double>(many.live - few.live) / more;
  const double archived = static_cast<double>(many.archived - few.archived) / more;
  std::printf(
      "a physical branch: %.0f bytes reported, %.0f with scratch memory, %.0f archived; "
      "%zu and %zu branches\n",
      reported, live, archived, few.branches, many.branches);
  EXPECT_EQ(sizeof(physics::Vec2) * 2, 4 * sizeof(double));  // the state of a joint
  EXPECT_LT(reported, 500.0);
  EXPECT_LT(live, 1600.0);
  EXPECT_LT(archived, 75.0);
}

}  // namespace
}  // namespace vegetation_sim::forest
