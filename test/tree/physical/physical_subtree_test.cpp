// Physical subtrees as state: reproducibility, replicas and accuracy.
#include "tree/physical/physical_subtree.h"

#include <gtest/gtest.h>

#include "heap.h"
#include "scenes/forest/physics_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::forest {
namespace {

/// A lateral pull at a limb for one second, then the recoil; in wind.
void pull(PhysicsRig& rig, double duration, const std::function<void()>& each = {}) {
  Grab grab = rig.grabOf(rig.branchOfDepth(2));
  const std::uint32_t id = rig.forest.addGrab(grab);
  int ticks = 0;
  rig.run(duration, [&] {
    if (ticks++ < TICK_RATE) {
      grab.target += Vec3(0.0, 0.3, -0.1) / TICK_RATE;
      rig.forest.moveGrab(id, grab.target);
    }
    if (ticks == TICK_RATE) rig.forest.release(id);
    if (each) each();
  });
}

PhysicsRig windyRig(const PhysicsSettings& settings = {}) {
  PhysicsRig out(settings);
  out.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  out.run(0.3);
  return out;
}

// N6: the same inputs give the same hash at every tick; a changed input does not.
TEST(PhysicalSubtree, RepeatedRunsHaveTheSameHash) {
  const auto hashes = [](double more) {
    PhysicsRig rig = windyRig();
    std::vector<std::uint64_t> out;
    rig.touch(rig.twig(), more);
    pull(rig, 3.0, [&] { out.push_back(rig.forest.hash()); });
    return out;
  };
  const auto a = hashes(0.5), b = hashes(0.5), c = hashes(0.6);
  EXPECT_EQ(a, b);
  EXPECT_NE(a, c);
}

// N6: a tree moves with the same bits for vectors of any width.
TEST(PhysicalSubtree, EveryInstructionSetHasTheSameHash) {
  const auto hashes = [](const std::string& set) {
    forceInstructionSet(set);
    PhysicsRig rig = windyRig();
    std::vector<std::uint64_t> out;
    pull(rig, 1.5, [&] { out.push_back(rig.forest.hash()); });
    EXPECT_GT(rig.forest.physicsFigures().branches, 10u);
    forceInstructionSet("");
    return out;
  };
  const auto best = hashes("");
  for (const std::string& set : instructionSets()) EXPECT_EQ(hashes(set), best) << set;
}

// S1-30: the default computes many joints at once in single precision. Through a pull, wind and
// recoil its tips stay with the double reference.
TEST(PhysicalSubtree, SinglePrecisionFollowsTheReference) {
  PhysicsSettings settings;
  EXPECT_EQ(settings.precision, Precision::SINGLE);
  PhysicsRig single = windyRig(settings);
  settings.precision = Precision::DOUBLE;
  PhysicsRig reference = windyRig(settings);
  std::vector<std::vector<Vec3>> tips[2];
  pull(single, 3.0, [&] { tips[0].push_back(tipsOf(single)); });
  pull(reference, 3.0, [&] { tips[1].push_back(tipsOf(reference)); });
  double worst = 0.0, motion = 0.0;
  for (std::size_t i = 0; i < tips[0].size(); ++i)
    for (std::size_t b = 0; b < tips[0][i].size(); ++b) {
      worst = std::max(worst, length(tips[0][i][b] - tips[1][i][b]));
      motion = std::max(motion, length(tips[1][i][b]));
    }
  std::printf("single precision: tips %.1e m off, of %.2f m\n", worst, motion);
  EXPECT_GT(motion, 0.2);
  EXPECT_GT(worst, 0.0);
  EXPECT_LT(worst, 1e-3 * motion);
}

// N6: a snapshot in mid-recoil is restored after other events.
TEST(PhysicalSubtree, RestoredForestGoesOnAsBefore) {
  PhysicsRig rig = windyRig();
  pull(rig, 1.5);
  const ForestSnapshot saved = rig.forest.snapshot();
  const std::int64_t tick = rig.tick;
  std::vector<std::uint64_t> first, second;
  rig.run(1.0, [&] { first.push_back(rig.forest.hash()); });
  rig.touch(0, 1.0);
  rig.run(0.5);
  rig.forest.restore(saved);
  rig.tick = tick;
  rig.run(1.0, [&] { second.push_back(rig.forest.hash()); });
  EXPECT_GT(rig.forest.physicsFigures().branches, 0u);
  EXPECT_EQ(first, second);
}

// A replica has the same branches, from the first touch to the end of the blend.
TEST(PhysicalSubtree, ReplicaPosesAreTheForests) {
  PhysicsSettings settings;
  settings.linger = 0.3;
  PhysicsRig rig = windyRig(settings);
  ForestReplica early, late;
  for (ForestReplica* replica : {&early, &late}) {
    replica->setLayout(rig.forest.layout(), flatTerrain());
    replica->setWind(rig.forest.snapshot().wind);
  }
  ASSERT_TRUE(early.apply(rig.forest.update(true)));
  int ticks = 0, blended = 0;
  double worst = 0.0;
  const auto compare = [&](const ForestReplica& replica) {
    const auto ours = rig.forest.pose(rig.tree, 0, rig.now());
    const auto theirs = replica.pose(rig.tree, 0, rig.now());
    for (std::size_t i = 0; i < ours.size(); ++i)
      worst = std::max(worst, length(ours[i].position - theirs[i].position));
  };
  pull(rig, 6.0, [&] {
    blended += rig.forest.physicsFigures().blending > 0 ? 1 : 0;
    const StateUpdate update = rig.forest.update(++ticks == 90);  // one key frame in mid-recoil
    ASSERT_TRUE(early.apply(update));
    compare(early);
    if (ticks < 90) return;
    ASSERT_TRUE(late.apply(update));
    compare(late);
  });
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(blended, 10);
  EXPECT_TRUE(early.physicalTrees().empty());
  EXPECT_TRUE(late.physicalTrees().empty());
}

// A gap in time is not stepped through and breaks nothing.
TEST(PhysicalSubtree, LongGapsAreNotSteppedThrough) {
  PhysicsRig rig = windyRig();
  pull(rig, 0.5);
  rig.tick += 100 * TICK_RATE;
  rig.advance();
  EXPECT_EQ(rig.forest.physicsFigures().steps, 0u);
  EXPECT_EQ(rig.forest.physicsFigures().skipped, 1u);
  rig.run(1.0);
  for (const PromotedBranch& b : rig.forest.promoted(0).branches)
    EXPECT_LT(difference(b.rate, {}), 100.0);
  rig.forest.reset();
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
  EXPECT_TRUE(rig.forest.grabs().empty());
}

// Steps are equal: ceil(240 Hz * time).
TEST(PhysicalSubtree, StepsAreAtLeast240AHertz) {
  PhysicsRig rig = windyRig();
  rig.touch(0, 10.0);
  rig.advance();
  EXPECT_EQ(rig.forest.physicsFigures().steps, 5u);  // a tick of 60 Hz is 16666667 ns now and then
  const Nanoseconds stamp = rig.now();
  rig.forest.advance(stamp + NANOSECONDS_PER_SECOND / 60);
  EXPECT_EQ(rig.forest.physicsFigures().steps, 4u);
  rig.forest.advance(stamp + NANOSECONDS_PER_SECOND / 60 + 1000);
  EXPECT_EQ(rig.forest.physicsFigures().steps, 1u);
  rig.forest.advance(stamp + NANOSECONDS_PER_SECOND / 60 + 1000 + NANOSECONDS_PER_SECOND);
  EXPECT_EQ(rig.forest.physicsFigures().steps, 240u);
}

// A plain step does not allocate after the first ones (S1-34: four numbers per branch are the
// state).
TEST(PhysicalSubtree, StepsAllocateNothing) {
  PhysicsRig rig = windyRig();
  Grab grab = rig.grabOf(rig.branchOfDepth(2));
  grab.target += Vec3(0.1, 0.1, 0.0);
  rig.forest.addGrab(grab);
  rig.run(0.2);
  PhysicalSubtree part = rig.forest.snapshot().physics.subtrees().at(0);
  SubtreeScratch scratch;
  SubtreeLoads loads;
  loads.springs.push_back({grab.point, grab.target, Vec3(Vec3::Zero()), rig.now(), 2000, 40, 200});
  const TreeWind air{rig.forest.snapshot().wind, rig.forest.world().levels.of(0),
                     rig.forest.layout().motion};
  PhysicsSettings settings;
  settings.precision = Precision::DOUBLE;
  std::size_t before = 0;
  for (int i = 0; i < 40; ++i) {
    if (i == 20) before = allocationCount();
    part.step(air, loads, settings, rig.now() + i * 4000000, rig.now() + (i + 1) * 4000000,
              scratch);
  }
  EXPECT_GT(part.joints().size(), 1u);
  EXPECT_EQ(allocationCount() - before, 0u);
  EXPECT_EQ(sizeof(part.state().q[0]) + sizeof(part.state().rate[0]), 4 * sizeof(double));
}

// E1, the default fade: after it, the tree is where full dynamics with the real load, a quarter of
// the step and no promotion have it.
TEST(PhysicalSubtree, AfterTheFadeItIsFullDynamics) {
  PhysicsSettings all;
  all.promotion = Promotion::DEPTH;
  PhysicsRig rig(all), reference(all);
  PhysicsSettings at_once = all;
  at_once.fade = 0.0;
  reference.forest.setPhysics(at_once);
  const wind::Field wind = steadyWind(Vec3(3, 1, 0));
  rig.forest.setWind(wind);
  reference.forest.setWind(wind);
  reference.touch(reference.twig(), 60.0);
  rig.run(5.0);
  rig.touch(rig.twig(), 60.0);
  Nanoseconds at = reference.now();
  const auto follow = [&] {  // at 960 Hz
    while (at < rig.now()) reference.forest.advance(at = std::min(at + 1041667, rig.now()));
  };
  follow();
  double last = 1.0;
  for (const double until : {0.0, 0.5, 1.0, 2.0, 4.0}) {
    std::vector<Vec3> error, motion;
    rig.run(until > 0.0 ? 0.5 : 0.1, [&] {
      follow();
      const auto a = tipsOf(rig), b = tipsOf(reference);
      for (std::size_t i = 0; i < a.size(); ++i)
        error.push_back(a[i] - b[i]), motion.push_back(b[i]);
    });
    last = rms(error) / rms(motion);
    std::printf("up to %.1f s after promotion: %.1f %% off full dynamics\n",
                secondsBetween(PHYSICS_START, rig.now()) - 5.0, 100.0 * last);
    rig.run(until > 0.5 ? until / 4 : 0.0);
  }
  EXPECT_LT(last, 0.01);
}

struct Clustered {
  double error{0.0};  ///< of the pulled tip over its motion, RMS
  double metres{0.0};
  std::size_t branches{0};
};

std::vector<Vec3> pulledTip(const PhysicsSettings& settings, bool all, std::size_t& branches) {
  PhysicsRig rig(settings);
  const int branch = rig.branchOfDepth(2);
  if (all) rig.touch(rig.twig(), 9.0);
  Push push;
  push.point = {0, branch, rig.branches()[branch].length};
  push.force = Vec3(0.0, 18.0, -9.0);
  push.until = rig.now() + seconds(1.0);
  rig.forest.push(push);
  std::vector<Vec3> out;
  const Vec3 rest = rig.tip(branch);
  branches = 0;
  rig.run(2.0, [&] {
    out.push_back(rig.tip(branch) - rest);
    branches = std::max(branches, rig.forest.physicsFigures().branches);
  });
  return out;
}

// S1-W9, N12: fewer branches cost less and are less accurate; the default is within a few per cent
// of the fully physical tree.
TEST(PhysicalSubtree, ClusteredErrorFallsWithTheBranchesThatArePhysical) {
  PhysicsSettings settings;
  settings.promotion = Promotion::DEPTH;
  std::size_t everything = 0;
  const auto truth = pulledTip(settings, true, everything);
  settings.promotion = Promotion::INFLUENCE;
  std::vector<Clustered> curve;
  for (const double tolerance : {0.3, 0.1, 0.03, 0.01, 0.005, 0.002, 0.0005}) {
    settings.influence_tolerance = tolerance;
    Clustered point;
    auto tip = pulledTip(settings, false, point.branches);
    for (std::size_t i = 0; i < tip.size(); ++i) tip[i] -= truth[i];
    point.metres = rms(tip);
    point.error = point.metres / rms(truth);
    std::printf("tolerance %6.4f m: %4zu of %zu branches, tip %.2f mm off = %.2f %%\n", tolerance,
                point.branches, everything, 1e3 * point.metres, 100.0 * point.error);
    curve.push_back(point);
  }
  EXPECT_LT(curve.back().error, 0.1 * curve.front().error);
  EXPECT_GT(curve.back().branches, curve.front().branches);
  EXPECT_LT(curve[4].metres, 0.005);  // the default tolerance holds
  EXPECT_LT(curve[4].branches, everything / 2);
}

// S1-30, S1-33: every method runs in a forest with its own steps.
TEST(PhysicalSubtree, EveryDynamicsAndIntegratorStaysBounded) {
  for (int dynamics = 0; dynamics < 3; ++dynamics) {
    for (int integrator = 0; integrator < 5; ++integrator) {
      PhysicsSettings settings;
      settings.dynamics = static_cast<physics::Dynamics>(dynamics);
      settings.integrator = static_cast<physics::Integrator>(integrator);
      PhysicsRig rig = windyRig(settings);
      double largest = 0.0;
      pull(rig, 1.5, [&] {
        for (const PromotedBranch& b : rig.forest.promoted(0).branches)
          largest = std::max(largest, difference(b.q, {}));
        EXPECT_EQ(rig.forest.physicsFigures().replaced, 0u) << dynamics << " " << integrator;
      });
      EXPECT_GT(largest, 1e-3) << dynamics << " " << integrator;
      EXPECT_LE(largest, LARGEST_BEND * (1.0 + 2e-6)) << dynamics << " " << integrator;
    }
  }
}

// S1-33: if wood is too stiff for the substeps of explicit methods, midpoint takes each step and it
// is counted.
TEST(PhysicalSubtree, StiffWoodIsRunByTheMidpointAndCounted) {
  std::vector<Vec3> tips;
  for (int integrator = 0; integrator < 5; ++integrator) {
    PhysicsSettings settings;
    settings.integrator = static_cast<physics::Integrator>(integrator);
    settings.precision = Precision::DOUBLE;
    settings.promotion = Promotion::DEPTH;
    PhysicsRig rig(settings);
    Layout stiff = rig.forest.layout();
    stiff.species[0].youngs_modulus = 1e12;
    rig.forest.setLayout(stiff, flatTerrain());
    Grab grab = rig.grabOf(rig.twig());
    grab.target += Vec3(0.0, 0.2, 0.1);
    rig.forest.addGrab(grab);
    std::size_t steps = 0, replaced = 0;
    rig.run(0.1, [&] {
      steps += rig.forest.physicsFigures().steps;
      replaced += rig.forest.physicsFigures().replaced;
    });
    const bool is_implicit = physics::isImplicit(settings.integrator);
    EXPECT_EQ(replaced, is_implicit ? 0u : steps) << integrator;
    tips.push_back(rig.tip(rig.twig()));
  }
  EXPECT_EQ(length(tips[2] - tips[3]), 0.0);
  EXPECT_EQ(length(tips[3] - tips[4]), 0.0);
  // The midpoint as chosen method also predicts drag.
  EXPECT_LT(length(tips[2] - tips[0]), 1e-4);
}

/// Returns the tip of a limb that is pulled for 0.1 s, in steps short enough for every method.
Vec3 pulledTip(const PhysicsSettings& settings) {
  constexpr int RATE = 64 * PHYSICS_RATE;
  PhysicsRig rig(settings);
  rig.grid = TickGrid(RATE);
  rig.tick = rig.grid.tickAt(rig.forest.snapshot().stamp);
  const int limb = rig.branchOfDepth(1);
  Grab grab = rig.grabOf(limb);
  grab.target += Vec3(0.1, 0.2, 0.0);
  rig.forest.addGrab(grab);
  for (int i = 0; i < RATE / 10; ++i) {
    rig.advance();
    EXPECT_EQ(rig.forest.physicsFigures().replaced, 0u) << static_cast<int>(settings.integrator);
  }
  return rig.tip(limb);
}

// S1-30, S1-31, S1-33: the chosen dynamics, integrator, precision and material determine the
// motion: no two choices have the same, and for short steps the integrators agree.
TEST(PhysicalSubtree, MovesByTheMethodThatIsChosen) {
  std::vector<Vec3> tips;
  for (const Material material : {Material::BEAM, Material::PAPER})
    for (int dynamics = 0; dynamics < 3; ++dynamics)
      for (int integrator = 0; integrator < 5; ++integrator) {
        PhysicsSettings settings;
        settings.promotion = Promotion::DEPTH;
        settings.precision = Precision::DOUBLE;
        settings.material = material;
        settings.dynamics = static_cast<physics::Dynamics>(dynamics);
        settings.integrator = static_cast<physics::Integrator>(integrator);
        tips.push_back(pulledTip(settings));
      }
  double same = 1.0, other = 1.0, apart = 0.0;
  for (std::size_t i = 0; i < tips.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = length(tips[i] - tips[j]);
      if (i / 5 == j / 5) apart = std::max(apart, distance);
      double& least = i / 5 == j / 5 ? same : other;
      least = std::min(least, distance);
    }
  std::printf("tips: integrators %.1e to %.1e m apart, dynamics and materials %.1e m\n", same,
              apart, other);
  EXPECT_GT(same, 1e-8);
  EXPECT_GT(other, 1e-3);
  EXPECT_LT(apart, other);
}

}  // namespace
}  // namespace vegetation_sim::forest
