// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// From procedural to physical and back.
#include <gtest/gtest.h>

#include "forest/physics_scene.h"

namespace vegetation_sim::forest {
namespace {

constexpr double HELD = 3600.0;  // [s] a fade that does not end

PhysicsSettings allOfIt() {
  PhysicsSettings out;
  out.promotion = static_cast<int>(Promotion::DEPTH);
  out.linger = 0.0;
  return out;
}

/// Largest over all joints of RMS(q - q~) over the amplitude of q~.
double differenceFromProcedural(const PhysicsSettings& settings) {
  PhysicsRig rig(settings);
  rig.forest.setWind(steadyWind(Vec3(2, 1, 0)));
  rig.run(0.5);
  rig.touch(rig.twig(), 10.0);
  const std::size_t n = rig.branches().size();
  std::vector<double> square(n, 0.0), amplitude(n, 0.0);
  double ticks = 0.0;
  rig.run(6.0, [&] {
    const auto a = rig.angles(rig.now()), b = rig.procedural(rig.now());
    for (std::size_t i = 0; i < n; ++i) {
      square[i] += std::pow(difference(a[i], b[i]), 2);
      amplitude[i] = std::max(amplitude[i], std::hypot(b[i].first, b[i].second));
    }
    ++ticks;
  });
  EXPECT_EQ(rig.forest.physicsFigures().branches, n);
  double worst = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    worst = std::max(worst, std::sqrt(square[i] / ticks) / amplitude[i]);
  return worst;
}

// N10, E1, S1-26: a whole tree made physical in steady wind moves as before; the printed form does
// not.
TEST(HandOver, CompensatedWindKeepsTheProceduralMotion) {
  PhysicsSettings settings = allOfIt();
  settings.fade = HELD;
  const double compensated = differenceFromProcedural(settings);
  settings.wind_forcing = static_cast<int>(WindForcing::PAPER);
  const double printed = differenceFromProcedural(settings);
  std::printf("RMS difference from procedural over amplitude: compensated %.2e, printed %.2f\n",
              compensated, printed);
  EXPECT_LT(compensated, 0.01);
  EXPECT_GT(printed, 0.5);
}

/// Seen angles around a switch: the largest jump against what rates foretell [rad], and of rates
/// over the peak rate.
struct Jump {
  double angle{0.0}, rate{0.0};
};

// Motion around a stamp at which something is switched, without stepping over it: the same forest
// with and without the switch differ by how its next short tick starts.
struct Limits {
  std::vector<JointAngles> q, rate;
};

// Right limits: over a tick of 10 microseconds, forward in time from the switch.
Limits limitsAfter(PhysicsRig& rig) {
  const Nanoseconds stamp = rig.forest.memory().stamp, small = 10000;
  const auto before = rig.angles(stamp);
  rig.forest.advance(stamp + small);
  const auto after = rig.angles(stamp + small);
  Limits out{before, before};
  for (std::size_t i = 0; i < before.size(); ++i) {
    out.rate[i].first = (after[i].first - before[i].first) / (small * 1e-9);
    out.rate[i].second = (after[i].second - before[i].second) / (small * 1e-9);
  }
  return out;
}

Jump compare(const Limits& left, const Limits& right, double peak) {
  Jump out;
  for (std::size_t i = 0; i < left.q.size(); ++i) {
    out.angle = std::max(out.angle, difference(left.q[i], right.q[i]));
    out.rate = std::max(out.rate, difference(left.rate[i], right.rate[i]) / peak);
  }
  return out;
}

// The rig as it stands and the same with a switch thrown: what both do in the next instant.
Jump jumpAt(const PhysicsRig& rig, double peak, const std::function<void(PhysicsRig&)>& change) {
  PhysicsRig with = rig, without = rig;
  change(with);
  const Limits left = limitsAfter(without), right = limitsAfter(with);
  return compare(left, right, peak);
}

double peakRate(PhysicsRig rig, double duration) {
  double out = 0.0;
  auto before = rig.angles(rig.now());
  rig.run(duration, [&] {
    const auto after = rig.angles(rig.now());
    for (std::size_t i = 0; i < after.size(); ++i)
      out = std::max(out, TICK_RATE * difference(before[i], after[i]));
    before = after;
  });
  return out;
}

constexpr double TENTH_OF_A_DEGREE = 0.1 * PI / 180.0;

// S1-36: going up, at any phase of the wind.
TEST(HandOver, PromotionJumpsNeitherInAngleNorInRate) {
  PhysicsRig rig(allOfIt());
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  const double peak = peakRate(rig, 3.5);
  Jump worst;
  for (int i = 0; i < 8; ++i) {
    rig.run(0.37);
    const Jump jump = jumpAt(rig, peak, [](PhysicsRig& r) { r.touch(r.twig(), 1.0); });
    worst = {std::max(worst.angle, jump.angle), std::max(worst.rate, jump.rate)};
  }
  std::printf("promotion: %.1e rad, %.1e of peak rate\n", worst.angle, worst.rate);
  EXPECT_LT(worst.angle, TENTH_OF_A_DEGREE);
  EXPECT_LT(worst.rate, 0.01);
}

/// A branch pulled aside and let go: in mid-recoil the blend starts.
PhysicsRig recoiling() {
  PhysicsSettings settings;
  settings.linger = 0.3;
  PhysicsRig rig(settings);
  rig.forest.setWind(steadyWind(Vec3(3, 1, 0)));
  rig.run(0.2);
  const int branch = rig.branchOfDepth(1);
  Grab grab = rig.grabOf(branch);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(0.5, [&] {
    grab.target += Vec3(0.0, 0.4, -0.2) / (0.5 * TICK_RATE);
    rig.forest.moveGrab(id, grab.target);
  });
  rig.forest.release(id);
  return rig;
}

// Largest change of any seen rate from one tenth of a millisecond to the next, over the peak rate,
// from the rig's time on.
double roughness(PhysicsRig rig, double duration, double peak) {
  constexpr Nanoseconds FINE = 100000;
  std::vector<JointAngles> before = rig.angles(rig.now()), rates;
  double out = 0.0;
  for (Nanoseconds t = FINE; t <= seconds(duration); t += FINE) {
    rig.forest.advance(rig.now() + t);
    const auto after = rig.angles(rig.now() + t);
    std::vector<JointAngles> now(after.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      now[i] = {(after[i].first - before[i].first) / (FINE * 1e-9),
                (after[i].second - before[i].second) / (FINE * 1e-9)};
      if (!rates.empty()) out = std::max(out, difference(now[i], rates[i]) / peak);
    }
    rates = now;
    before = after;
  }
  return out;
}

// S1-37: going down, where branches start to blend and where they have blended.
TEST(HandOver, DemotionJumpsNeitherInAngleNorInRate) {
  PhysicsRig rig = recoiling();
  const double peak = peakRate(rig, 1.0);
  rig.run(0.1);  // letting go is a step of force, not of ours
  double worst = 0.0;
  int switches = 0;
  for (int i = 0; i < 4 * TICK_RATE; ++i) {
    const PhysicsRig before = rig;
    rig.advance();
    const PhysicsFigures a = before.forest.physicsFigures(), b = rig.forest.physicsFigures();
    if (a.blending == b.blending && a.branches == b.branches) continue;
    ++switches;
    worst = std::max(worst, roughness(before, 2.0 / TICK_RATE, peak));
  }
  std::printf("demotion: %d switches, %.1e of peak rate\n", switches, worst);
  EXPECT_GE(switches, 2);
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
  EXPECT_LT(worst, 0.01);
}

// S1-37: what is seen is (1 - a) physical + a procedural with a = 3 u^2 - 2 u^3 over 1.5 s.
TEST(HandOver, BlendIsThePapersSmoothStep) {
  PromotedBranch branch{0, {}, {}, PHYSICS_START};
  const auto at = [&](double u) {
    return blendWeight(branch, PHYSICS_START + seconds(1.5 * u), 1.5);
  };
  EXPECT_DOUBLE_EQ(at(0.25), 0.15625);
  EXPECT_DOUBLE_EQ(at(0.5), 0.5);
  EXPECT_DOUBLE_EQ(at(0.75), 0.84375);
  EXPECT_EQ(at(-1.0), 0.0);
  EXPECT_EQ(at(2.0), 1.0);
  EXPECT_EQ(PhysicsSettings().blend, 1.5);
}

// S1-37, S1-38: the blend starts, is taken back and ends without a jump, at any instant of it.
TEST(HandOver, RegrabInTheBlendJumpsNeitherInAngleNorInRate) {
  PhysicsRig rig = recoiling();
  const double peak = peakRate(rig, 1.0);
  while (rig.forest.physicsFigures().blending == 0) rig.advance();
  Jump worst;
  int tried = 0;
  while (rig.forest.physicsFigures().blending > 0) {
    if (++tried % 7 == 0) {
      const Jump jump = jumpAt(rig, peak, [](PhysicsRig& r) { r.touch(r.branchOfDepth(1), 9.0); });
      worst = {std::max(worst.angle, jump.angle), std::max(worst.rate, jump.rate)};
    }
    rig.advance();
  }
  std::printf("regrab: %.1e rad, %.1e of peak rate, of %d instants\n", worst.angle, worst.rate,
              tried / 7);
  EXPECT_GT(tried, 60);
  EXPECT_LT(worst.angle, TENTH_OF_A_DEGREE);
  EXPECT_LT(worst.rate, 0.01);
}

// S1-25: nothing is held before a branch is touched, and nothing after it has blended back.
TEST(HandOver, NothingIsHeldBeforeAndAfter) {
  PhysicsRig rig({}, 4);
  rig.run(0.2);
  EXPECT_EQ(rig.forest.physicsFigures().bytes, 0u);
  const std::uint64_t untouched = rig.forest.memory().physics.parts().size();
  EXPECT_EQ(untouched, 0u);
  Grab grab = rig.grabOf(rig.branchOfDepth(1));
  grab.target += Vec3(0.3, 0.0, 0.0);
  const std::uint32_t id = rig.forest.addGrab(grab);
  rig.run(1.0);
  const PhysicsFigures during = rig.forest.physicsFigures();
  EXPECT_EQ(during.trees, 1u);
  EXPECT_GT(during.branches, 0u);
  EXPECT_GT(during.bytes, 0u);
  rig.forest.release(id);
  rig.run(10.0);
  const PhysicsFigures after = rig.forest.physicsFigures();
  EXPECT_EQ(after.trees, 0u);
  EXPECT_EQ(after.branches, 0u);
  EXPECT_EQ(after.bytes, 0u);
  EXPECT_TRUE(rig.forest.memory().physics.parts().empty());
  std::printf("during: %zu branches, %zu bytes\n", during.branches, during.bytes);
}

// E6: without wind a tree keeps its rest shape through promotion, physics, blend and after.
TEST(HandOver, WithoutWindTheRestShapeStays) {
  PhysicsRig rig(allOfIt());
  const auto rest = rig.forest.pose(rig.tree, 0, rig.now());
  rig.touch(rig.twig(), 1.0);
  rig.run(4.0, [&] {
    const auto poses = rig.forest.pose(rig.tree, 0, rig.now());
    for (std::size_t i = 0; i < rest.size(); ++i)
      ASSERT_LT(length(poses[i].position - rest[i].position), 1e-12) << i;
  });
  EXPECT_EQ(rig.forest.physicsFigures().branches, 0u);
}

}  // namespace
}  // namespace vegetation_sim::forest
