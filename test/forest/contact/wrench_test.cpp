// Reactions on grippers and bodies, tick by tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/forest/contact_scene.h"
#include "scenes/forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

constexpr int WINDOWS = 6;  // of 1/60 s

/// Reactions on a gripper that moves a twig 2 cm aside in one tick of 60 Hz and holds it, at `rate`
/// Hz.
struct TwigPull {
  std::vector<Vec3> impulse;  ///< of windows of 1/60 s [N s]
  std::vector<Vec3> last;     ///< published force at the end of each [N]

  explicit TwigPull(int rate) : impulse(WINDOWS, Vec3(Vec3::Zero())), last(WINDOWS) {
    PhysicsSettings settings;
    settings.promotion = Promotion::DEPTH;  // the same branches at every rate
    PhysicsRig rig(settings);
    rig.grid = TickGrid(rate);
    rig.tick = rig.grid.tickAt(rig.forest.snapshot().stamp);
    Grab grab = rig.grabOf(rig.twig());
    grab.stiffness = 300.0;
    grab.damping = 2.0;
    const std::uint32_t id = rig.forest.addGrab(grab);
    const int share = rate / TICK_RATE;
    for (int i = 0; i < WINDOWS * share; ++i) {
      if (i < share) rig.forest.moveGrab(id, grab.target += Vec3(0.0, 0.02, 0.0) / share);
      rig.advance();
      const auto window = static_cast<std::size_t>(i / share);
      last[window] = rig.forest.reactions().at(0).force;
      impulse[window] += last[window] / rate;
    }
  }
};

// N3. The reaction at 60 Hz is the mean of the tick: it has the impulse of runs whose ticks and
// steps are 64 and 16 times finer, unlike a sample at the end of the tick.
TEST(Wrench, OfAHandIsTheMeanOfItsTick) {
  const TwigPull coarse(TICK_RATE), fine(64 * TICK_RATE);
  double largest = 0.0, worst = 0.0, sampled = 0.0;
  for (std::size_t i = 0; i < WINDOWS; ++i) {
    largest = std::max(largest, length(fine.impulse[i]));
    worst = std::max(worst, length(coarse.impulse[i] - fine.impulse[i]));
    sampled = std::max(sampled, length(fine.last[i] / TICK_RATE - fine.impulse[i]));
  }
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(worst, 0.01 * largest);
  EXPECT_GT(sampled, 0.1 * largest);
}

// N3. After a gap in time there is no mean: the reaction is the spring's force at the visible
// point.
TEST(Wrench, OfAHandIsTheSpringsOwnWhereTheClockLeaps) {
  PhysicsRig rig;
  Grab grab = rig.grabOf(rig.twig());
  grab.stiffness = 50.0;
  grab.damping = 2.0;
  grab.target += Vec3(0.0, 0.02, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(2.0);
  for (const int ticks : {10 * TICK_RATE, -5 * TICK_RATE}) {
    rig.forest.moveGrab(id, grab.target += Vec3(0.0, 0.01, 0.0));
    rig.tick += ticks;
    rig.advance();
    ASSERT_EQ(rig.forest.reactions().size(), 1u);
    const Reaction& published = rig.forest.reactions()[0];
    EXPECT_LT(length(published.point - rig.tip(rig.twig())), 1e-9);
    const Vec3 spring = grab.stiffness * (grab.target - published.point);
    EXPECT_GT(length(spring), 0.05);
    EXPECT_LT(length(published.force + spring), 1e-6) << ticks;
    rig.run(1.0);
  }
}

/// Sums of the reactions on two bodies that meet a trunk from two sides, over some ticks [N s].
struct TwoRams {
  std::map<std::string, Vec3> published;
  ContactRecorder recorder;

  TwoRams(double first, double second) {
    Ram rams(1.0, TICKS, 0.3, {first, second});
    rams.forest().setContactFinder(recorder.makeFinder());
    for (int i = 0; i < 4; ++i) {
      rams.driveOn();
      for (const Reaction& reaction : rams.forest().reactions()) {
        if (reaction.at.branch != 0) ADD_FAILURE() << reaction.at.branch;
        EXPECT_LE(length(reaction.force), physics::ContactLaw().force_limit * (1.0 + 1e-9));
        published.emplace(reaction.body, Vec3::Zero()).first->second += reaction.force / TICKS;
      }
    }
  }
};

// N3. Each body gets its own reaction with its own limit; the branch gets their sum, with the same
// substep resolution as for one.
TEST(Wrench, OfTwoBodiesOnABranchIsEachOnesOwn) {
  const double limit = physics::ContactLaw().force_limit, tick = 1.0 / TICKS;
  TwoRams beside(-0.8, 0.8), swapped(0.8, -0.8), pinch(0.0, PI);
  for (TwoRams* rams : {&beside, &swapped, &pinch}) {
    ASSERT_EQ(rams->published.size(), 2u);
    const Vec3 sum = rams->published["arm0"] + rams->published["arm1"];
    EXPECT_LT(length(sum + rams->recorder.impulse), 1e-5 * rams->recorder.size);
    EXPECT_LE(rams->recorder.rise, SubstepBisection::MAX_FORCE_CHANGE * limit * (1.0 + 1e-9));
  }
  EXPECT_LT(length(beside.published["arm0"] - swapped.published["arm1"]), 1e-3 * limit * tick);
  EXPECT_LT(length(beside.published["arm1"] - swapped.published["arm0"]), 1e-3 * limit * tick);
  EXPECT_GT(length(beside.recorder.impulse), 4.0 * limit * tick);  // more than one body could give
  EXPECT_LT(beside.published["arm0"].y() * beside.published["arm1"].y(), 0.0);
  EXPECT_LT(pinch.published["arm0"].x(), -3.0 * limit * tick);
  EXPECT_GT(pinch.published["arm1"].x(), 3.0 * limit * tick);
}

}  // namespace
}  // namespace vegetation_sim::forest
