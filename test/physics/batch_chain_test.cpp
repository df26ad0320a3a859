// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/physics/batch_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "physics/chain_scene.h"
#include "vegetation_sim/common/faults.h"
#include "vegetation_sim/common/instruction_set.h"
#include "vegetation_sim/physics/twin_chains.h"

namespace vegetation_sim::physics {
namespace {

using Trees = std::vector<std::vector<Link>>;
constexpr double STEP = 1.0 / 240.0;

// Tips' error over the farthest that any tip went. Float keeps 6e-8 an operation; measured 2e-7 to
// 6e-7 over 3 s for 1 to 1 001 links.
constexpr double BAR = 3e-6;
// A spring of 5 kN/m makes 4 mN of the float's last bit 8 m up; measured 4e-5.
constexpr double BAR_HELD = 2e-4;

std::vector<Vec3> tipsOf(const std::vector<Link>& links, const ChainState& state,
                         const std::vector<BaseMotion>& bases = {}) {
  const Kinematics k = kinematicsAt(links, state, bases);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < links.size(); ++i)
    out.push_back(k.pose[i].position + links[i].length * axisZ(k.pose[i].orientation));
  return out;
}

/// Both batched steppers do the same.
template <class Batch>
class Batched : public testing::Test {
 protected:
  /// Largest distance of a tip from the plain stepper's over the largest way of any tip.
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
using Steppers = testing::Types<BatchChain, TwinChains>;
TYPED_TEST_SUITE(Batched, Steppers);

// ---- against the plain stepper -----------------------------------------------------------------

TYPED_TEST(Batched, FollowsThePlainStepperThroughGustAndPull) {
  for (const int n : {1, 7, 100, 1001}) {
    const std::vector<Link> links = fractalTree(n, 3);
    const double error = this->error(links, gustAndPull(links, 18.0, 20.0), 3.0);
    EXPECT_LT(error, BAR) << n;
  }
}

TYPED_TEST(Batched, FollowsThePlainStepperAlongADeepChain) {
  std::vector<Link> links = beam(64, 3.0, 0.01, 8e9, 900.0);
  damp(links);
  EXPECT_LT(this->error(links, gustAndPull(links, 18.0, 1.0), 3.0), BAR);
}

// Bends on both sides of where the series change, fast: every velocity product counts. The error is
// that of the step's change of rates, over the largest change; measured 1e-6.
TYPED_TEST(Batched, StepsFromAnyStateAsThePlainStepper) {
  const std::vector<Link> links = fractalTree(40, 4);
  for (const double angle : {0.3, 0.9, 2.5}) {
    Simulation plain{links};
    TypeParam batch(Trees{links});
    const ChainState start = randomState(links.size(), angle, 8.0, 3);
    plain.state = start;
    batch.setState(0, start);
    plain.step({}, 0.0, STEP);
    batch.step(STEP);
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
TYPED_TEST(Batched, ParentsFeelAllTheirChildren) {
  std::vector<Link> links{bar(-1, 0.0, 1.0, 0.02, 8e9, 900.0)};
  for (int i = 0; i < 37; ++i) {
    links.push_back(bar(0, 0.02 * i, 0.3 + 0.01 * i, 0.004, 8e9, 900.0));
    links.back().rest = Quat{std::cos(0.1 * i), 0.0, 0.0, std::sin(0.1 * i)} *
                        Quat{std::cos(0.3), std::sin(0.3), 0.0, 0.0};
  }
  damp(links);
  EXPECT_LT(this->error(links, gustAndPull(links, 18.0, 20.0), 3.0), BAR);
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
  EXPECT_LT(this->error(links, gustAndPull(links, 18.0, 20.0), 3.0), BAR);
}

// A gripper's springs, far stiffer than what they hold, two of them on one link.
Surroundings gripper(const std::vector<Link>& links) {
  Surroundings out;
  const Kinematics rest = kinematicsAt(links, atRest(links.size()));
  out.loads = [&links, rest](const Kinematics& k, double time, Loads& loads) {
    const std::size_t thick = thickEnough(links);
    for (const std::size_t i : {links.size() - 1, thick, thick}) {
      const auto point = [&](const Pose& pose) {
        return Vec3(pose.position + 0.7 * links[i].length * axisZ(pose.orientation));
      };
      Anchor a;
      a.link = static_cast<int>(i);
      a.arm = point(k.pose[i]) - k.pose[i].position;
      const Vec3 velocity = k.velocity[i] + k.spin[i].cross(a.arm);
      const Vec3 target = point(rest.pose[i]) + 0.1 * smootherStep(time) * Vec3(1.0, 0.5, -0.2);
      a.force = 5000.0 * (target - point(k.pose[i])) - 20.0 * velocity;
      a.stiffness = {5000.0, 5000.0, 5000.0, 0.0, 0.0, 0.0};
      a.damping = {20.0, 20.0, 20.0, 0.0, 0.0, 0.0};
      loads.anchors.push_back(a);
    }
  };
  return out;
}

TYPED_TEST(Batched, AnchorsHoldAsInThePlainStepper) {
  const std::vector<Link> links = fractalTree(100, 4);
  EXPECT_LT(this->error(links, gripper(links), 2.0), BAR_HELD);
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
  EXPECT_LT(this->error(links, around, 2.0), BAR);
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

// ---- bits --------------------------------------------------------------------------------------

// Trees of odd sizes and shapes in a storm, held and shaken: every path of the kernels.
template <class Batch>
std::vector<ChainState> storm(const Trees& trees) {
  Batch batch(trees);
  std::vector<Surroundings> around;
  for (const std::vector<Link>& links : trees) {
    around.push_back(gustAndPull(links, 100.0, 50.0));
    around.back().bases = [](double t, std::vector<BaseMotion>& bases) {
      bases.assign(1, BaseMotion());
      bases[0].spin = Vec3(std::sin(t), 0.0, 0.3);
      bases[0].acceleration = Vec3(0.0, 5.0 * std::cos(t), 0.0);
    };
    const auto air = around.back().loads, held = gripper(links).loads;
    around.back().loads = [air, held](const Kinematics& k, double t, Loads& loads) {
      air(k, t, loads);
      if (t > 0.2) held(k, t, loads);
    };
  }
  for (std::size_t t = 0; t < trees.size(); ++t)
    batch.setState(static_cast<int>(t), randomState(trees[t].size(), 0.8, 3.0, t));
  for (int i = 0; i < 120; ++i) batch.step(around, i * STEP, STEP);
  std::vector<ChainState> out;
  for (int t = 0; t < batch.treeCount(); ++t) out.push_back(batch.state(t));
  return out;
}

bool sameBits(const ChainState& a, const ChainState& b) {
  for (std::size_t i = 0; i < a.q.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (std::memcmp(&a.q[i][axis], &b.q[i][axis], sizeof(double)) != 0 ||
          std::memcmp(&a.rate[i][axis], &b.rate[i][axis], sizeof(double)) != 0)
        return false;
  return a.q.size() == b.q.size();
}

template <class Batch>
void expectSameBits(const Trees& trees) {
  const std::vector<std::string> sets = instructionSets();
  ASSERT_GE(sets.size(), 2u);
  const std::vector<ChainState> best = storm<Batch>(trees);
  double largest = 0.0;
  for (const ChainState& state : best)
    for (const Vec2& q : state.q) largest = std::max({largest, std::fabs(q.x()), std::fabs(q.y())});
  EXPECT_GT(largest, 1.0);  // or the rotation series for large bends went unseen
  EXPECT_LT(largest, 1e3);
  for (const std::string& set : sets) {
    forceInstructionSet(set);
    const std::vector<ChainState> other = storm<Batch>(trees);
    forceInstructionSet("");
    for (std::size_t t = 0; t < best.size(); ++t)
      EXPECT_TRUE(sameBits(best[t], other[t])) << set << " tree " << t;
  }
}

TEST(BatchChain, GivesTheSameBitsOnEveryInstructionSet) {
  Trees trees;
  for (const int n : {1, 7, 33, 1001, 100, 2}) trees.push_back(fractalTree(n, 7));
  trees[2][5].inertia.xy = 1e-3 * trees[2][5].inertia.xx;  // no bar
  expectSameBits<BatchChain>(trees);
}

TEST(TwinChains, GivesTheSameBitsOnEveryInstructionSet) {
  Trees trees(21, fractalTree(101, 7));
  for (std::size_t t = 0; t < trees.size(); ++t)
    for (Link& link : trees[t]) link.stiffness *= 1.0 + 0.1 * static_cast<double>(t);
  expectSameBits<TwinChains>(trees);
}

// Who else is in the batch, and in which lane a link ends up, does not matter.
TEST(BatchChain, TreesDoNotFeelEachOther) {
  Trees trees;
  for (const int n : {7, 100, 1001, 1500, 33}) trees.push_back(fractalTree(n, 7));
  trees[1][5].inertia.xy = 1e-3 * trees[1][5].inertia.xx;  // no bar
  const std::vector<ChainState> together = storm<BatchChain>(trees);
  for (std::size_t t = 0; t < trees.size(); ++t) {
    Trees others(t, fractalTree(3, 1));  // the same index, and so the same start
    others.push_back(trees[t]);
    EXPECT_TRUE(sameBits(storm<BatchChain>(others)[t], together[t])) << t;
  }
}

// ---- stability ---------------------------------------------------------------------------------

// Largest |q| over a storm and its ring-down, and at the end.
struct Bends {
  double largest{0.0}, last{0.0};
};

template <class Batch>
Bends bendsIn(const std::vector<Link>& links, const Surroundings& around, double h,
              double seconds) {
  Batch batch(Trees{links});
  Bends out;
  const int steps = static_cast<int>(seconds / h);
  for (int i = 0; i < steps; ++i) {
    batch.step(std::vector<Surroundings>{around}, i * h, h);
    out.last = 0.0;
    for (const Vec2& q : batch.state(0).q) out.last = std::max(out.last, q.norm());
    out.largest = std::max(out.largest, out.last);
    if (!(out.last < 1e6)) break;
  }
  return out;
}

// Issue 3: bounded in float for every step from 0.1 to 50 ms with stiffness 1e6 apart in one tree
// and storms of 30x gust; the bound is that of the plain stepper's test, and all joints come back.
TYPED_TEST(Batched, StaysBoundedForEveryStepInAnyStorm) {
  std::vector<Link> links = crown(63, 0.1);
  links[0].stiffness = 0.0;
  const auto softer = [](const Link& a, const Link& b) { return a.stiffness < b.stiffness; };
  links[0].stiffness = 1e6 * std::min_element(links.begin() + 1, links.end(), softer)->stiffness;
  const Surroundings blow = gust(links, 30.0 * 20.0);
  for (const double h : {1e-4, 1e-3, STEP, 1.0 / 60.0, 0.03, 0.05}) {
    const Bends bends = bendsIn<TypeParam>(links, blow, h, h < 1e-3 ? 1.5 : 12.0);
    EXPECT_LT(bends.largest, 20.0) << h;
    EXPECT_LT(bends.last, h < 1e-3 ? 20.0 : 0.05) << h;
  }
  const std::vector<Link> tree = fractalTree(60, 9);
  const Surroundings storm = gustAndPull(tree, 30.0 * 18.0, 0.0);
  for (const double h : {1e-4, 1e-3, STEP, 1.0 / 60.0, 0.03, 0.05}) {
    const Bends bends = bendsIn<TypeParam>(tree, storm, h, 2.0);
    EXPECT_LT(bends.largest, 1.0) << h;
    EXPECT_LT(bends.last, 0.1) << h;
  }
}

// A tree left alone ends at rest for good: numbers too small to be normal would slow every step.
TYPED_TEST(Batched, ComesToRestExactly) {
  const std::vector<Link> links = fractalTree(20, 9);
  TypeParam batch(Trees{links});
  batch.setState(0, randomState(links.size(), 0.01, 0.0, 1));
  for (int i = 0; i < 20000; ++i) batch.step(0.02);
  for (const Vec2& q : batch.state(0).q) ASSERT_EQ(q, Vec2::Zero());
}

// ---- interface ---------------------------------------------------------------------------------

TYPED_TEST(Batched, LoadsThatStandActAsThoseAskedFor) {
  const Trees trees(3, fractalTree(33, 2));
  Loads loads;
  loads.clear(33);
  for (std::size_t i = 0; i < 33; ++i) {
    loads.wrench[i] = {Vec3(0.1, 0.2, -0.3), Vec3(0.01, 0.0, 0.02)};
    loads.joint_torque[i] = Vec2(0.05, -0.02);
  }
  TypeParam asked(trees), kept(trees);
  Surroundings around;
  around.loads = [&](const Kinematics&, double, Loads& out) { out = loads; };
  for (int t = 0; t < 3; ++t) kept.setLoads(t, loads);
  for (int i = 0; i < 50; ++i) {
    asked.step(std::vector<Surroundings>(3, around), i * STEP, STEP);
    kept.step(STEP);
  }
  for (int t = 0; t < 3; ++t) EXPECT_TRUE(sameBits(asked.state(t), kept.state(t)));
  EXPECT_GT(kept.state(2).q[0].norm(), 0.0);
  asked.step(std::vector<Surroundings>(3), 0.0, STEP);  // nothing acts any more
  kept.setLoads(1, Loads());
  kept.step(STEP);
  EXPECT_TRUE(sameBits(asked.state(1), kept.state(1)));
  EXPECT_FALSE(sameBits(asked.state(2), kept.state(2)));
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

TEST(TwinChains, RefusesAnotherTopology) {
  Trees trees(2, fractalTree(5, 2));
  trees[1][4].parent = 0;
  try {
    TwinChains twins(trees);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(
        error.what(),
        ("tree 1, link 4: parent 0; as in tree 0, " + std::to_string(trees[0][4].parent)).c_str());
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
