// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Velocity products of physical branches: foretold within a tick, averaged where branches are
// thrown.
#include <gtest/gtest.h>

#include "scenes/forest/physics_scene.h"
#include "tree/physical/physical_subtree.h"

namespace vegetation_sim::forest {
namespace {

/// A tree, physical throughout, that swings free after a shove [N]; in still air, where nothing but
/// velocity products is held for a tick.
struct Swinging {
  static constexpr Nanoseconds TICK = 16666664;  ///< four steps, the same of four parts
  PhysicsRig rig;
  std::vector<Vec3> tips;  ///< of all ticks

  // `parts`: a tick is advanced in so many.
  Swinging(const PhysicsSettings& settings, const Vec3& shove, int parts) : rig(settings) {
    rig.touch(rig.twig(), 9.0);
    Push push;
    push.point = {0, rig.branchOfDepth(1), 0.5 * rig.branches()[rig.branchOfDepth(1)].length};
    push.force = shove;
    push.until = rig.now() + 30 * TICK;
    rig.forest.push(push);
    Nanoseconds now = rig.now();
    for (int tick = 0; tick < 3 * TICK_RATE; ++tick, now += TICK) {
      for (int i = 1; i <= parts; ++i) rig.forest.advance(now + TICK * i / parts);
      for (const Vec3& tip : tipsOf(rig)) tips.push_back(tip);
    }
  }
};

double rmsBetween(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(a[i] - b[i]);
  return rms(out);
}

/// How far ticks, and steps on their own, are off what is converged and off each other, over the
/// way.
struct Foretold {
  double ticks, steps, between, way;

  explicit Foretold(const Vec3& shove) {
    PhysicsSettings settings;
    settings.promotion = Promotion::DEPTH;
    settings.fade = 0.0;
    const Swinging in_ticks(settings, shove, 1), in_steps(settings, shove, 4);
    settings.precision = Precision::DOUBLE;
    const Swinging exact(settings, shove, 64);
    way = rms(exact.tips);
    ticks = rmsBetween(in_ticks.tips, exact.tips) / way;
    steps = rmsBetween(in_steps.tips, exact.tips) / way;
    between = rmsBetween(in_ticks.tips, in_steps.tips) / way;
    std::printf("%.0f N: tips move by %.3f m; ticks %.2e off, steps %.2e, between them %.2e\n",
                length(shove), way, ticks, steps, between);
  }
};

// A tick's steps after its first foretell the rates of velocity products; ticks as short as a step
// average them, and are the same to the bit where nobody foretells.
TEST(PhysicalSubtree, StepsOfATickForetellVelocityProducts) {
  const Foretold shoved(Vec3(0.0, 150.0, -50.0));
  EXPECT_GT(shoved.way, 0.005);
  EXPECT_GT(shoved.between, 1e-4);
  EXPECT_LT(shoved.ticks, 1.1 * shoved.steps);
}

// What is thrown is averaged in each step: foretold, it was 9.0e-3 off.
TEST(PhysicalSubtree, BranchesThatAreThrownAreAsRightInTicksAsInSteps) {
  const Foretold thrown(Vec3(0.0, 600.0, -200.0));
  EXPECT_GT(thrown.way, 0.02);
  EXPECT_LT(thrown.steps, 3e-3);
  EXPECT_LT(thrown.ticks, 1.1 * thrown.steps);
}

}  // namespace
}  // namespace vegetation_sim::forest
