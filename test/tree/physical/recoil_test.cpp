// Velocity products of physical branches: predicted within a tick, averaged where branches move
// fast.
#include <gtest/gtest.h>

#include "scenes/forest/physics_scene.h"
#include "tree/physical/physical_subtree.h"

namespace vegetation_sim::forest {
namespace {

/// A fully physical tree that oscillates freely after a push [N], in still air, where only velocity
/// products are kept for a tick.
struct Swinging {
  static constexpr Nanoseconds TICK = 16666664;  ///< four equal steps
  PhysicsRig rig;
  std::vector<Vec3> tips;  ///< of all ticks

  // `parts` is the number of calls per tick.
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

/// Errors of ticks and of single steps against the converged motion and each other, relative to the
/// motion.
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

// Steps after the first of a tick predict the rates of velocity products; ticks of one step average
// them, with the same bits as without prediction.
TEST(PhysicalSubtree, StepsOfATickForetellVelocityProducts) {
  const Foretold shoved(Vec3(0.0, 150.0, -50.0));
  EXPECT_GT(shoved.way, 0.005);
  EXPECT_GT(shoved.between, 1e-4);
  EXPECT_LT(shoved.ticks, 1.1 * shoved.steps);
}

// Fast motion is averaged in each step; predicted, the error was 9.0e-3.
TEST(PhysicalSubtree, BranchesThatAreThrownAreAsRightInTicksAsInSteps) {
  const Foretold thrown(Vec3(0.0, 600.0, -200.0));
  EXPECT_GT(thrown.way, 0.02);
  EXPECT_LT(thrown.steps, 3e-3);
  EXPECT_LT(thrown.ticks, 1.1 * thrown.steps);
}

}  // namespace
}  // namespace vegetation_sim::forest
