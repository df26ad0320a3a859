// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/batch_step/batch_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/dynamics/chain_scene.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::physics {
namespace {

using Trees = std::vector<std::vector<Link>>;

// Tolerance of the tips' error over the largest motion of a tip. Float keeps 6e-8 per operation;
// measured 2e-7 to 6e-7 over 3 s for 1 to 5 000 links.
constexpr double TOLERANCE = 3e-6;
// A spring of 5 kN/m makes 4 mN of the float's last bit 8 m up; measured 4e-5.
constexpr double TOLERANCE_HELD = 2e-4;

std::vector<Vec3> tipsOf(const std::vector<Link>& links, const ChainState& state,
                         const std::vector<BaseMotion>& bases = {}) {
  const Kinematics k = kinematicsAt(links, state, bases);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < links.size(); ++i)
    out.push_back(k.pose[i].position + links[i].length * axisZ(k.pose[i].orientation));
  return out;
}

/// Both batched steppers must pass the same tests.
template <class Batch>
class Batched : public testing::Test {
 protected:
  /// Returns the largest distance of a tip from the plain stepper's over the largest motion of any
  /// tip.
  double error(const std::vector<Link>& links, const Surroundings& around, double seconds,
               double h = STEP) {
    Simulation plain{links};
    Batch batch(Trees{links});
    const std::vector<Vec3> rest = tipsOf(links, plain.state);
    double worst = 0.0, way = 0.0;
    const int steps = static_cast<int>(seconds / h + 0.5);
    for (int i = 0; i < steps; ++i) {
      plain.step(around, i * h, h);
      batch.step(std::vector<Surroundings>{around}, i * h, h);
      EXPECT_NEAR(batch.theta(0), plain.theta, 1e-12) << i;
      if (i % 6) continue;
      const auto fast = tipsOf(links, batch.state(0)), slow = tipsOf(links, plain.state);
      for (std::size_t t = 0; t < links.size(); ++t) {
        worst = std::max(worst, length(fast[t] - slow[t]));
        way = std::max(way, length(slow[t] - rest[t]));
      }
    }
    EXPECT_GT(way, 1e-4);
    return worst / way;
  }
};
using Steppers = testing::Types<BatchChain>;
TYPED_TEST_SUITE(Batched, Steppers);

// ---- against the plain stepper -----------------------------------------------------------------

TYPED_TEST(Batched, FollowsThePlainStepperThroughGustAndPull) {
  for (const int n : {1, 7, 100, 1001}) {
    const std::vector<Link> links = fractalTree(n, 3);
    const double error = this->error(links, gustAndPull(links, 18.0, 20.0), 3.0);
    EXPECT_LT(error, TOLERANCE) << n;
  }
}

// This tree has more links than a group holds otherwise.
using LargeTree = Batched<BatchChain>;
TEST_F(LargeTree, FollowsThePlainStepperThroughGustAndPull) {
  const std::vector<Link> links = fractalTree(5000, 3);
  EXPECT_LT(error(links, gustAndPull(links, 18.0, 20.0), 3.0), TOLERANCE);
}

TYPED_TEST(Batched, FollowsThePlainStepperThroughQuadraticDrag) {
  const std::vector<Link> links = fractalTree(100, 3);
  EXPECT_LT(this->error(links, quadraticGust(links, 18.0), 2.0), TOLERANCE);
}

TYPED_TEST(Batched, FollowsThePlainStepperAlongADeepChain) {
  std::vector<Link> links = beam(64, 3.0, 0.01, 8e9, 900.0);
  damp(links);
  EXPECT_LT(this->error(links, gustAndPull(links, 18.0, 1.0), 3.0), TOLERANCE);
}

// Bends on both sides of where the series change, and at their stops, fast: every velocity product
// counts; in a long step none does, and turns are stopped. The error is that of the step's change
// of rates, over the largest change; measured 1e-6.
TYPED_TEST(Batched, StepsFromAnyStateAsThePlainStepper) {
  const std::vector<Link> links = fractalTree(40, 4);
  for (const double angle : {0.3, 0.9, 2.5, -0.3, -2.5}) {  // negative: the long step
    const double h = angle > 0.0 ? STEP : 0.1;
    Simulation plain{links};
    TypeParam batch(Trees{links});
    const ChainState start = randomState(links.size(), std::fabs(angle), 8.0, 3);
    plain.state = start;
    batch.setState(0, start);
    plain.step({}, 0.0, h);
    batch.step(h);
    const ChainState end = batch.state(0);
    double worst = 0.0, change = 0.0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      worst = std::max(worst, (end.rate[i] - plain.state.rate[i]).norm());
      change = std::max(change, (plain.state.rate[i] - start.rate[i]).norm());
    }
    EXPECT_LT(worst, 5e-6 * change) << angle;
  }
}

// S1-31: 37 children of one parent, in no multiple of any vector.
TYPED_TEST(Batched, ParentsBearAllTheirChildren) {
  std::vector<Link> links{bar(-1, 0.0, 1.0, 0.02, 8e9, 900.0)};
  for (int i = 0; i < 37; ++i) {
    links.push_back(bar(0, 0.02 * i, 0.3 + 0.01 * i, 0.004, 8e9, 900.0));
    links.back().rest = Quat{std::cos(0.1 * i), 0.0, 0.0, std::sin(0.1 * i)} *
                        Quat{std::cos(0.3), std::sin(0.3), 0.0, 0.0};
  }
  damp(links);
  EXPECT_LT(this->error(links, gustAndPull(links, 18.0, 20.0), 3.0), TOLERANCE);
}

// S1-W9: bodies of any shape, as clusters of wood are.
TYPED_TEST(Batched, FollowsThePlainStepperWithBodiesOfAnyShape) {
  std::vector<Link> links = fractalTree(60, 5);
  for (std::size_t i = 0; i < links.size(); i += 3) {
    const double m = links[i].mass, r = 0.3 * links[i].length;
    const Vec3 arm(r, -0.5 * r, 0.2 * r);  // a point mass beside the bar
    Link& link = links[i];
    link.centre = (m * link.centre + m * arm) / (2.0 * m);
    link.mass = 2.0 * m;
    link.inertia.xx += m * (arm.y() * arm.y() + arm.z() * arm.z());
    link.inertia.yy += m * (arm.x() * arm.x() + arm.z() * arm.z());
    link.inertia.zz += m * (arm.x() * arm.x() + arm.y() * arm.y());
    link.inertia.xy -= m * arm.x() * arm.y();
    link.inertia.xz -= m * arm.x() * arm.z();
    link.inertia.yz -= m * arm.y() * arm.z();
  }
  EXPECT_LT(this->error(links, gustAndPull(links, 18.0, 20.0), 3.0), TOLERANCE);
}

TYPED_TEST(Batched, AnchorsHoldAsInThePlainStepper) {
  const std::vector<Link> links = fractalTree(100, 4);
  EXPECT_LT(this->error(links, gripper(links), 2.0), TOLERANCE_HELD);
}

TYPED_TEST(Batched, RootsFollowTheirBases) {
  std::vector<Link> links = fractalTree(40, 4);
  for (const Link& link : fractalTree(23, 6)) {
    links.push_back(link);
    if (link.parent < 0) {
      links.back().base = 1;
      links.back().h = 0.3;
    } else {
      links.back().parent += 40;
    }
  }
  Surroundings around;
  around.bases = [](double t, std::vector<BaseMotion>& bases) {
    bases.assign(2, BaseMotion());
    const double w = 4.0, a = 0.2;
    bases[0].pose.position = Vec3(a * std::sin(w * t), 0.0, 0.0);
    bases[0].velocity = Vec3(a * w * std::cos(w * t), 0.0, 0.0);
    bases[0].acceleration = Vec3(-a * w * w * std::sin(w * t), 0.0, 0.0);
    const double turn = a * std::sin(w * t);
    bases[1].pose = {Vec3(500.0, 1.0, 2.0), {std::cos(turn / 2), std::sin(turn / 2), 0.0, 0.0}};
    bases[1].spin = Vec3(a * w * std::cos(w * t), 0.0, 0.0);
    bases[1].spin_rate = Vec3(-a * w * w * std::sin(w * t), 0.0, 0.0);
  };
  EXPECT_LT(this->error(links, around, 2.0), TOLERANCE);
}

TYPED_TEST(Batched, TheGuardActsAsInThePlainStepper) {
  const std::vector<Link> links = fractalTree(30, 4);
  const Surroundings wind = gustAndPull(links, 18.0, 20.0);
  Simulation plain{links};
  TypeParam batch(Trees{links});
  plain.state = randomState(30, 0.1, 20.0, 3);  // 20 rad/s: 0.33 rad a step
  batch.setState(0, plain.state);
  int guarded = 0, on_the_way_back = 0;
  for (int i = 0; i < 120; ++i) {
    plain.step(wind, i / 60.0, 1.0 / 60.0);
    batch.step(std::vector<Surroundings>{wind}, i / 60.0, 1.0 / 60.0);
    ASSERT_EQ(batch.theta(0), plain.theta) << i;
    guarded += plain.theta == 1.0;
    on_the_way_back += plain.theta > 0.5 && plain.theta < 1.0;
  }
  EXPECT_GT(guarded, 0);
  EXPECT_GT(on_the_way_back, 3);
  EXPECT_EQ(plain.theta, 0.5);
}

// ---- interface ---------------------------------------------------------------------------------

TYPED_TEST(Batched, LoadsEndWithTheFunctionThatGaveThem) {
  const Trees trees(3, fractalTree(33, 2));
  Loads loads;
  loads.clear(33);
  for (std::size_t i = 0; i < 33; ++i) {
    loads.wrench[i] = {Vec3(0.1, 0.2, -0.3), Vec3(0.01, 0.0, 0.02)};
    loads.joint_torque[i] = Vec2(0.05, -0.02);
  }
  TypeParam loaded(trees), fresh(trees);
  Surroundings around;
  around.loads = [&](const Kinematics&, double, Loads& out) { out = loads; };
  for (int i = 0; i < 50; ++i) loaded.step(std::vector<Surroundings>(3, around), i * STEP, STEP);
  EXPECT_GT(loaded.state(2).q[0].norm(), 0.0);
  for (int t = 0; t < 3; ++t) fresh.setState(t, loaded.state(t));
  for (TypeParam* chain : {&loaded, &fresh}) chain->step(std::vector<Surroundings>(3), 0.0, STEP);
  for (int t = 0; t < 3; ++t) EXPECT_TRUE(sameBits(loaded.state(t), fresh.state(t)));
}

// The loads depend on the motion of the links that have them.
TYPED_TEST(Batched, LoadsOnAFewNamedLinksGiveTheBitsOfLoadsOnAll) {
  const Trees trees(2, fractalTree(60, 4));
  TypeParam few(trees), all(trees);
  for (int i = 0; i < 60; ++i) {
    const std::vector<std::size_t> links =
        i < 20 ? std::vector<std::size_t>{3, 41} : std::vector<std::size_t>{0, 41, 59};
    Surroundings around;
    if (i < 40)
      around.loads = [&](const Kinematics& k, double, Loads& out) {
        for (const std::size_t link : links) {
          out.wrench[link].force += Vec3(0.3, 0.1, 0.0) - 0.2 * k.velocity[link];
          out.joint_torque[link] += Vec2(0.01, 0.02);
        }
        const Vec3 arm(0.0, 0.0, 0.1), force = -50.0 * (k.pose[41].position + arm);
        out.anchors.push_back({41, arm, force, {50.0, 50.0, 50.0, 0.0, 0.0, 0.0}, {}});
      };
    all.step(std::vector<Surroundings>(2, around), i * STEP, STEP);
    few.setLoadedLinks(&links);
    few.step(std::vector<Surroundings>(2, around), i * STEP, STEP);
    for (int t = 0; t < 2; ++t) ASSERT_TRUE(sameBits(few.state(t), all.state(t))) << "step " << i;
  }
  EXPECT_GT(few.state(1).q[41].norm(), 1e-3);
}

TYPED_TEST(Batched, KnowsWhetherAJointIsBeyondALimit) {
  const Trees trees(2, fractalTree(40, 4));
  TypeParam chain(trees);
  ChainState state = chain.state(1);
  const auto isWithin = [&](double q, double rate) {
    state.q[30] = Vec2(0.0, q);
    state.rate[30] = Vec2(rate, 0.0);
    chain.setState(1, state);
    return chain.isWithin(3.0, 100.0);
  };
  EXPECT_TRUE(isWithin(2.999, 99.9));
  EXPECT_FALSE(isWithin(3.001, 0.0));
  EXPECT_FALSE(isWithin(0.0, -100.1));
  EXPECT_FALSE(isWithin(std::nan(""), 0.0));
}

TYPED_TEST(Batched, RefusesSurroundingsForOtherTrees) {
  TypeParam batch(Trees(3, fractalTree(3, 2)));
  EXPECT_THROW(batch.step(std::vector<Surroundings>(2), 0.0, STEP), InvalidInput);
}

TYPED_TEST(Batched, NoTreeAndEmptyTreesStepToo) {
  TypeParam none((Trees()));
  none.step(STEP);
  TypeParam empty(Trees(2));
  empty.step(STEP);
  EXPECT_TRUE(empty.state(1).q.empty());
}

}  // namespace
}  // namespace vegetation_sim::physics
