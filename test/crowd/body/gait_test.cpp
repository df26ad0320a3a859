// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/gait.h"

#include <gtest/gtest.h>

#include "crowd/body/body_skeleton.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double DEGREE = PI / 180.0;

// S2-35: the curves and their slopes have no jump anywhere, the cycle's end included.
TEST(Gait, JointsAreSmoothAllRoundTheCycle) {
  constexpr int COUNT = 10000;
  Joints before = jointsAt(-1.0 / COUNT), rate_before = jointRatesAt(-1.0 / COUNT);
  for (int i = 0; i <= COUNT; ++i) {
    const double phase = static_cast<double>(i) / COUNT;
    const Joints now = jointsAt(phase), rate = jointRatesAt(phase);
    for (const auto joint :
         {&Joints::hip, &Joints::knee, &Joints::ankle, &Joints::shoulder, &Joints::elbow}) {
      ASSERT_LT(std::fabs(now.*joint - before.*joint), 0.002) << phase;       // C0
      ASSERT_LT(std::fabs(rate.*joint - rate_before.*joint), 0.06) << phase;  // C1
      // The slopes are those of the values.
      ASSERT_NEAR((now.*joint - before.*joint) * COUNT, rate.*joint, 0.06) << phase;
    }
    before = now;
    rate_before = rate;
  }
}

// What every textbook shows of natural walking.
TEST(Gait, JointsAreThoseOfAPerson) {
  EXPECT_NEAR(jointsAt(0.0).hip / DEGREE, 20.0, 5.0);
  EXPECT_NEAR(jointsAt(0.51).hip / DEGREE, -11.0, 4.0);
  EXPECT_NEAR(jointsAt(0.72).knee / DEGREE, 63.0, 6.0);
  EXPECT_LT(jointsAt(0.97).knee / DEGREE, 8.0);
  EXPECT_LT(jointsAt(0.62).ankle / DEGREE, -14.0);
  // The arm goes against the leg of its side.
  EXPECT_LT(jointsAt(0.0).shoulder, jointsAt(0.5).shoulder);
}

// S2-35
TEST(Gait, StrideAndAmplitudeGrowWithSpeed) {
  double stride = 0.0, amplitude = 0.0;
  for (double speed = 0.0; speed < 2.0; speed += 0.1) {
    EXPECT_GE(strideLength(speed, 1.75), stride);
    EXPECT_GT(gaitAmplitude(speed, 1.75), amplitude - 1e-12);
    stride = strideLength(speed, 1.75);
    amplitude = gaitAmplitude(speed, 1.75);
  }
  EXPECT_NEAR(strideLength(1.35, 1.75), 1.42, 1e-12);
  EXPECT_EQ(gaitAmplitude(0.0, 1.75), 0.0);
}

struct Walk {
  double slip{0.0};     ///< of the part of the foot that is on the ground, in any one stance [m]
  double jump{0.0};     ///< largest step of any limb's end [m]
  double stretch{0.0};  ///< of a leg's bones [m]
  double lowest{1e9};   ///< point of a sole [m]
  double highest_toe{0.0};
};

// The place of a foot's flat ball, from the limbs: the end that the foot rolls over.
Walk walk(double speed, double bend) {
  constexpr double DT = 1.0 / 120.0;
  Walk out;
  Walker w;
  w.feet[0].planted = w.feet[1].planted = {};
  const terrain::HeightMap ground;
  Vec3 stood[2];
  bool standing[2] = {false, false};
  Skeleton before;
  for (int i = 0; i < 1200; ++i) {
    w.heading += bend * DT;
    const SinCos turn = sinCos(w.heading);
    w.velocity = {speed * turn.cos, speed * turn.sin};
    w.position = w.position + DT * w.velocity;
    advanceGait(speed * DT, w);
    const Skeleton s = skeletonOf(w, ground);
    for (int side = 0; side < 2 && i > 240; ++side) {
      const Limb& foot = limbOf(s, Part::FOOT, side);
      const Limb &thigh = limbOf(s, Part::THIGH, side), &shank = limbOf(s, Part::SHANK, side);
      out.stretch = std::max(
          {out.stretch, std::fabs(length(thigh.to - thigh.from) - Proportions::THIGH * w.height),
           std::fabs(length(shank.to - shank.from) - Proportions::SHANK * w.height)});
      out.lowest = std::min({out.lowest, foot.from.z() - foot.radius, foot.to.z() - foot.radius});
      out.highest_toe = std::max(out.highest_toe, foot.to.z());
      // Flat on the ground, both ends stand; the toes from then on.
      const bool stands = footPhase(w, side) > 0.1 && footPhase(w, side) < STANCE;
      const Vec3 toe(foot.to.x(), foot.to.y(), 0.0);
      if (stands && !standing[side]) stood[side] = toe;
      if (stands) out.slip = std::max(out.slip, length(toe - stood[side]));
      standing[side] = stands;
    }
    for (std::size_t k = 0; k < PARTS && i > 240; ++k)
      out.jump = std::max({out.jump, length(s[k].to - before[k].to)});
    before = s;
  }
  return out;
}

// S2-35: at most 2 cm.
TEST(Gait, FeetStayWhereTheyStand) {
  for (const double speed : {0.5, 1.0, 1.35, 1.8})
    for (const double bend : {0.0, 0.4, -0.8}) {
      const Walk found = walk(speed, bend);
      EXPECT_LT(found.slip, 0.02) << speed << " " << bend;
      // Twice as fast as a swinging foot moves: nothing jumps.
      EXPECT_LT(found.jump, 6.0 * speed / 120.0 + 0.01) << speed << " " << bend;
      EXPECT_GT(found.lowest, -0.03) << speed << " " << bend;
      EXPECT_GT(found.highest_toe, 0.03) << speed;
      EXPECT_LT(found.stretch, 0.02) << speed << " " << bend;
    }
}

TEST(Gait, StandingFeetAreUnderTheBody) {
  Walker w;
  w.velocity = {};
  advanceGait(0.0, w);
  const Skeleton s = skeletonOf(w, terrain::HeightMap());
  EXPECT_NEAR(limbOf(s, Part::HEAD).to.z() + Proportions::HEAD * w.height, w.height, 0.08);
  for (int side = 0; side < 2; ++side) EXPECT_LT(length(limbOf(s, Part::FOOT, side).from), 0.3);
}

}  // namespace
}  // namespace vegetation_sim::crowd
