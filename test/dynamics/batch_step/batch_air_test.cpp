// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "dynamics/batch_step/batch_chain.h"
#include "scenes/dynamics/chain_scene.h"
#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/wind/field.h"
#include "wind/sampling/batch_wind.h"

namespace vegetation_sim::physics {
namespace {

// The grips of quadraticGust.
std::vector<Grip> gripsOf(const std::vector<Link>& links) {
  std::vector<Grip> out;
  for (const Link& link : links)
    out.push_back({Vec3(0.1, 0.0, 0.8) * link.length, 0.0, 0.05 * link.length});
  return out;
}

WindQuery uniform(const Vec3& wind) {
  return [wind](const float*, float* air, std::size_t blocks) {
    for (std::size_t i = 0; i < 48 * blocks; ++i)
      air[i] = static_cast<float>(wind[static_cast<int>(i % 48 / 16)]);
  };
}

/// The drag of air that moves with `wind` everywhere, as loads.
Surroundings steadyDrag(const std::vector<Link>& links, const std::vector<Grip>& grips,
                        const Vec3& wind) {
  Surroundings out;
  out.loads = [&links, &grips, wind](const Kinematics& k, double, Loads& loads) {
    loads.drag.resize(links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Vec3 arm = rotate(k.pose[i].orientation, grips[i].centre);
      const Vec3 past = wind - k.velocity[i] - cross(k.spin[i], arm);
      const double size = length(past), drag = grips[i].steady + grips[i].square * size;
      loads.wrench[i].force = drag * past;
      loads.wrench[i].torque = cross(arm, loads.wrench[i].force);
      if (size > 0.0) loads.drag[i] = {arm, drag, std::sqrt(grips[i].square / size) * past};
    }
  };
  return out;
}

wind::Field breeze() {
  wind::Primitive out;
  out.kind = wind::Kind::BREEZE;
  out.name = "breeze";
  out.velocity = Vec3(8.0, 3.0, 0.0);
  out.turbulence = 0.3;
  return wind::Field({out});
}

/// Returns the tips of a tree after 5 s in a breeze that is queried every so many steps, in the
/// middle of them.
std::vector<Vec3> tipsInBreeze(const std::vector<Link>& links, int every) {
  const wind::Field field = breeze();
  BatchChain chain(links);
  chain.setGrips(0, gripsOf(links));
  for (int i = 0; i < 1200; ++i) {
    if (i % every == 0) {
      const forest::FloatWind now(field.at(fromSeconds((i + 0.5 * every) * STEP)), 1e3);
      chain.queryWind([now](const float* places, float* air, std::size_t blocks) {
        fillWind(now, places, air, blocks);
      });
    }
    chain.step(STEP);
  }
  const Kinematics end = kinematicsAt(links, chain.state(0));
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < links.size(); ++i)
    out.push_back(end.pose[i].position + links[i].length * axisZ(end.pose[i].orientation));
  return out;
}

double largestDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, length(a[i] - b[i]));
  return out;
}

TEST(BatchAir, TakesOneGripForEachLinkOrNone) {
  const std::vector<Link> links = fractalTree(40, 3);
  BatchChain chain(links);
  std::vector<Grip> grips = gripsOf(links);
  grips.pop_back();
  EXPECT_THROW(chain.setGrips(0, grips), InvalidInput);
}

// S1-26: the wind in a chain's own rows is the load that a caller would have computed. The
// tolerance is that of loads: float's rounding over 2 s.
TEST(BatchAir, IsTheQuadraticDragOfLoads) {
  const std::vector<Link> links = fractalTree(100, 3);
  Simulation plain{links};
  BatchChain chain(links);
  chain.setGrips(0, gripsOf(links));
  const Surroundings around = quadraticGust(links, 18.0);
  double worst = 0.0, largest = 0.0;
  for (int i = 0; i < 480; ++i) {
    const double time = i * STEP, swell = sinCos(PI * (time + 0.5 * STEP)).sin;
    const double speed = time < 1.0 ? 18.0 * swell * swell : 0.0;
    plain.step(around, time, STEP);
    chain.queryWind(uniform(speed * Vec3(1.0, 0.3, 0.1)));
    chain.step(STEP);
    const ChainState now = chain.state(0);
    for (std::size_t k = 0; k < links.size(); ++k) {
      worst = std::max(worst, (now.q[k] - plain.state.q[k]).norm());
      largest = std::max(largest, plain.state.q[k].norm());
    }
  }
  EXPECT_GT(largest, 0.05);
  EXPECT_LT(worst, 1e-5 * largest);
}

TEST(BatchAir, IsAskedForWhereGripsAreOnTheirBases) {
  const std::vector<Link> links = fractalTree(40, 3);
  BatchChain chain(links);
  const std::vector<Grip> grips = gripsOf(links);
  chain.setGrips(0, grips);
  BaseMotion base;
  base.pose.position = Vec3(3.0, -2.0, 1.0);
  Surroundings around;
  around.bases = [&](double, std::vector<BaseMotion>& out) { out = {base}; };
  std::vector<Vec3> places;
  chain.queryWind([&](const float* rows, float*, std::size_t blocks) {
    for (std::size_t i = 0; i < 16 * blocks; ++i)
      places.emplace_back(rows[i / 16 * 48 + i % 16], rows[i / 16 * 48 + 16 + i % 16],
                          rows[i / 16 * 48 + 32 + i % 16]);
  });
  chain.step(around, 0.0, STEP);
  const Kinematics rest = kinematicsAt(links, atRest(links.size()), {base});
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Vec3 grip = rest.pose[i].position + rotate(rest.pose[i].orientation, grips[i].centre);
    double nearest = 1.0;
    for (const Vec3& place : places) nearest = std::min(nearest, length(place - grip));
    EXPECT_LT(nearest, 1e-5) << i;
  }
}

// Wind at 60 Hz serves steps of 240 Hz: measured 4e-4 of the tips' distance from rest.
TEST(BatchAir, HeldForAFrameIsNearAirOfEachStep) {
  const std::vector<Link> links = fractalTree(200, 3);
  const std::vector<Vec3> each = tipsInBreeze(links, 1);
  const Kinematics rest = kinematicsAt(links, atRest(links.size()));
  std::vector<Vec3> still;
  for (std::size_t i = 0; i < links.size(); ++i)
    still.push_back(rest.pose[i].position + links[i].length * axisZ(rest.pose[i].orientation));
  const double way = largestDistance(each, still);
  EXPECT_GT(way, 0.01);
  EXPECT_GT(largestDistance(tipsInBreeze(links, 4), each), 0.0);
  EXPECT_LT(largestDistance(tipsInBreeze(links, 4), each), 5e-3 * way);
}

TEST(BatchAir, MovesTheSameBitsOnEveryInstructionSet) {
  const std::vector<Link> links = fractalTree(200, 3);
  std::vector<Vec3> first;
  for (const std::string& set : instructionSets()) {
    forceInstructionSet(set);
    const std::vector<Vec3> tips = tipsInBreeze(links, 4);
    forceInstructionSet("");
    if (first.empty()) first = tips;
    EXPECT_EQ(largestDistance(tips, first), 0.0) << set;
  }
}

// Bars with air on their axes, the usual case, take a shorter path, in vectors of their own or
// beside trees with other grips, also after grips beside the axes were removed.
TEST(BatchAir, OnTheAxesOfBarsIsTheSameBesideOthers) {
  const std::vector<Link> links = fractalTree(100, 3);
  std::vector<Grip> on_axis = gripsOf(links);
  for (Grip& grip : on_axis) grip.centre.x() = 0.0;
  std::vector<Grip> mixed = on_axis;
  for (std::size_t i = 0; i < links.size(); i += 3) mixed[i] = gripsOf(links)[i];
  const auto blow = [](BatchChain& chain) {
    chain.queryWind(uniform(Vec3(10.0, 3.0, 1.0)));
    for (int i = 0; i < 120; ++i) chain.step(STEP);
  };
  BatchChain alone(links), beside({links, links}), back({links, links});
  alone.setGrips(0, on_axis);
  beside.setGrips(0, on_axis);
  beside.setGrips(1, mixed);
  for (const auto* grips : {&mixed, &on_axis})
    for (const int tree : {0, 1}) back.setGrips(tree, *grips);
  for (BatchChain* chain : {&alone, &beside, &back}) blow(*chain);
  EXPECT_GT(alone.state(0).q.back().norm(), 1e-3);
  EXPECT_TRUE(sameBits(alone.state(0), beside.state(0)));
  EXPECT_FALSE(sameBits(alone.state(0), beside.state(1)));
  EXPECT_TRUE(sameBits(alone.state(0), back.state(1)));
}

// Both paths are correct: the plain stepper's error is float's rounding over a second.
TEST(BatchAir, OnAndBesideTheAxesIsTheQuadraticDragOfLoads) {
  const std::vector<Link> links = fractalTree(100, 3);
  for (const double beside : {0.0, 0.1}) {
    Simulation plain{links};
    BatchChain chain(links);
    std::vector<Grip> grips;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const double x = i % 2 ? beside : 0.0;
      grips.push_back({Vec3(x, 0.0, 0.8) * links[i].length, 0.02, 0.05 * links[i].length});
    }
    chain.setGrips(0, grips);
    const Vec3 wind(12.0, 3.0, 1.0);
    chain.queryWind(uniform(wind));
    const Surroundings around = steadyDrag(links, grips, wind);
    for (int i = 0; i < 240; ++i) {
      plain.step(around, i * STEP, STEP);
      chain.step(STEP);
    }
    double worst = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      worst = std::max(worst, (chain.state(0).q[k] - plain.state.q[k]).norm());
      largest = std::max(largest, plain.state.q[k].norm());
    }
    EXPECT_GT(largest, 0.05);
    EXPECT_LT(worst, 1e-5 * largest) << beside;
  }
}

// Four steps of one group, then of the next, equal four steps of all, in groups of bars and others.
TEST(BatchAir, StepsOfAFrameAreTheSameTogether) {
  std::vector<std::vector<Link>> trees;
  for (const int n : {1500, 1001, 33}) trees.push_back(fractalTree(n, 7));
  trees[2][5].inertia.xy = 1e-3 * trees[2][5].inertia.xx;  // not a bar
  BatchChain together(trees), apart(trees);
  const auto blow = [&](BatchChain& chain, double speed) {
    for (int t = 0; t < 3; ++t) chain.setGrips(t, gripsOf(trees[static_cast<std::size_t>(t)]));
    chain.queryWind(uniform(Vec3(speed, 3.0, 1.0)));
  };
  for (int frame = 0; frame < 10; ++frame) {
    blow(together, 2.0 * frame);
    blow(apart, 2.0 * frame);
    together.step(STEP, 4);
    for (int i = 0; i < 4; ++i) apart.step(std::vector<Surroundings>(3), 0.0, STEP, i);
  }
  for (int t = 0; t < 3; ++t) {
    EXPECT_GT(together.state(t).q.back().norm(), 0.0);
    EXPECT_TRUE(sameBits(together.state(t), apart.state(t))) << t;
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
