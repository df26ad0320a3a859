// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Grabs of every branch.
#include <gtest/gtest.h>

#include "forest/pick.h"
#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

constexpr int MOST = 40;  // physical branches

PhysicsSettings fewBranches() {
  PhysicsSettings out;
  out.most_branches = MOST;
  return out;
}

// S1-02: a grab of any branch of 256 trees is accepted.
TEST(GrabOfEveryBranch, IsAcceptedIn256Trees) {
  PhysicsRig rig({}, 16);
  ASSERT_EQ(rig.forest.layout().treeCount(), 256u);
  std::size_t grabbed = 0;
  for (std::uint32_t id = 0; id < 256; ++id) {
    const Tree tree = growTree(rig.forest.layout(), id, rig.forest.terrain());
    for (const Branch& b : tree.skeleton.branches) {
      Grab grab;
      grab.point = {id, static_cast<int>(&b - tree.skeleton.branches.data()), 0.5 * b.length};
      grab.target = tree.foot + b.rest.position + grab.point.along * axisZ(b.rest.orientation);
      ASSERT_NO_THROW(rig.forest.release(rig.forest.addGrab(grab)))
          << id << " " << grab.point.branch;
      ++grabbed;
    }
  }
  std::printf("%zu branches of 256 trees\n", grabbed);
  EXPECT_GT(grabbed, 256u * 100u);
}

/// Extremes of the grabs of all branches of a tree.
struct Extremes {
  std::size_t physical{0}, moved{0};
  double left{0.0};  // largest distance between a tip after its release and where it belongs [m]
};

// Grabs a branch, pulls it sideways, releases it and waits until nothing is physical.
void grabOnce(int branch, Extremes& out) {
  PhysicsRig rig(fewBranches());
  const BranchPoint point{0, branch, rig.branches()[branch].length};
  Grab grab;
  grab.point = point;
  const Vec3 before = rig.pointOn(point);
  grab.target = before + Vec3(0.0, 0.3, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  const auto check = [&] {
    const std::size_t physical = rig.forest.physicsFigures().branches;
    out.physical = std::max(out.physical, physical);
    for (const PromotedBranch& b : rig.forest.promoted(0).branches)
      ASSERT_TRUE(std::isfinite(b.q.first + b.q.second + b.rate.first + b.rate.second)) << branch;
  };
  rig.run(0.25, check);
  ASSERT_GT(rig.forest.physicsFigures().branches, 0u) << branch;
  const double way = dot(rig.pointOn(point) - before, Vec3::UnitY());
  EXPECT_GT(way, 0.0) << branch;
  out.moved += way > 0.01;
  rig.forest.release(id);
  rig.run(PhysicsSettings().linger + PhysicsSettings().blend + 0.3, check);
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u) << branch;
  out.left = std::max(out.left, length(rig.pointOn(point) - before));
}

// S1-02: every branch of a tree follows a grab, and returns when it is released. The work of a tick
// is bounded by the number of physical branches.
TEST(GrabOfEveryBranch, MovesItAndLetsItReturn) {
  const PhysicsRig rig(fewBranches());
  const int branches = static_cast<int>(rig.branches().size());
  Extremes all;
  for (int branch = 0; branch < branches; ++branch) grabOnce(branch, all);
  std::printf("of %d branches, %zu move by over 10 mm, at most %zu are physical, %.1e m remain\n",
              branches, all.moved, all.physical, all.left);
  EXPECT_LE(all.physical, static_cast<std::size_t>(MOST));
  EXPECT_GT(all.moved, rig.branches().size() * 9 / 10);
  EXPECT_LT(all.left, 1e-9);  // still air: what is procedural stands at rest
}

/// Largest work of a tick while a twig is pulled in each of some trees.
struct Work {
  std::size_t trees{0}, branches{0}, links{0}, refused{0};
  std::size_t in_the_trees{0};  ///< branches of the trees that are held
};

Work workOfGrabs(std::uint32_t grabs, const PhysicsSettings& settings) {
  PhysicsRig rig(settings, 16);
  rig.forest.setWind(steadyWind(Vec3(3.0, 1.0, 0.0)));
  Work out;
  for (std::uint32_t id = 0; id < grabs; ++id) {
    const Tree tree = growTree(rig.forest.layout(), id, rig.forest.terrain());
    const Branch& twig = tree.skeleton.branches.back();
    Grab grab;
    grab.point = {id, static_cast<int>(tree.skeleton.branches.size()) - 1, twig.length};
    grab.target = tree.foot + tipOf(twig, twig.rest) + Vec3(0.0, 0.2, 0.0);
    rig.forest.addGrab(grab);
    out.in_the_trees += tree.skeleton.branches.size();
  }
  rig.run(1.0, [&] {
    const PhysicsFigures now = rig.forest.physicsFigures();
    out.trees = std::max(out.trees, now.trees);
    out.branches = std::max(out.branches, now.branches);
    out.links = std::max(out.links, now.branches * now.steps);
    out.refused = std::max(out.refused, now.refused);
  });
  return out;
}

// S1-02: what bounds the time of a tick when 40 twigs of 256 trees are held: links that are
// evaluated, which are physical branches times steps. grab_bench measures the time of ticks.
TEST(GrabOfEveryBranch, OfManyTreesLeavesTheWorkOfATickBounded) {
  constexpr std::size_t GRABS = 40, MOST_STEPS = 5, FEW = 30;  // 240 Hz for ticks of 60 Hz
  const Work free = workOfGrabs(GRABS, PhysicsSettings());
  EXPECT_EQ(free.trees, GRABS);
  EXPECT_GT(free.branches, FEW);
  EXPECT_LT(free.branches, free.in_the_trees / 2);
  EXPECT_LE(free.links, MOST_STEPS * free.branches);
  PhysicsSettings settings;
  settings.most_branches = FEW;
  const Work limited = workOfGrabs(GRABS, settings);
  std::printf("40 grabs: %zu physical branches and %zu links a tick; limited: %zu and %zu\n",
              free.branches, free.links, limited.branches, limited.links);
  EXPECT_LE(limited.branches, FEW);
  EXPECT_LE(limited.links, MOST_STEPS * FEW);
  EXPECT_GT(limited.refused, 0u);
}

// S1-02: a ray that starts beside a branch picks it, and the picked branch can be grabbed.
TEST(GrabOfEveryBranch, FollowsFromPickingIt) {
  PhysicsRig rig;
  const auto tree = std::make_shared<const Tree>(rig.tree);
  const PosedTree posed{tree, rig.forest.pose(rig.tree, 0, rig.now())};
  for (std::size_t b = 0; b < posed.poses.size(); ++b) {
    const Branch& branch = rig.branches()[b];
    const Pose& pose = posed.poses[b];
    const Vec3 target =
        rig.tree.foot + pose.position + 0.5 * branch.length * axisZ(pose.orientation);
    Ray ray;
    ray.direction = rotate(pose.orientation, Vec3::UnitX());
    ray.origin = target - (branch.base_radius + 1e-4) * ray.direction;
    const auto hit = pickTree(rig.forest.layout(), rig.forest.terrain(), ray,
                              [&](std::uint32_t) { return posed; });
    ASSERT_TRUE(hit) << b;
    EXPECT_EQ(hit->tree, 0u);
    if (hit->branch != static_cast<int>(b)) {  // grown into another branch
      EXPECT_LT(hit->distance, 2.0 * branch.base_radius + 1e-3) << b;
    }
    Grab grab;
    grab.point = {hit->tree, hit->branch, hit->along};
    grab.target = hit->point;
    ASSERT_NO_THROW(rig.forest.release(rig.forest.addGrab(grab))) << b;
  }
}

}  // namespace
}  // namespace vegetation_sim::forest
