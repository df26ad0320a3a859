// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/motion_style.h"

#include <gtest/gtest.h>

#include <set>

#include "core/config/files.h"
#include "crowd/body/body_skeleton.h"
#include "crowd/body/bvh_clip.h"
#include "package_folder.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

constexpr double FRAME = 1.0 / 120.0, TO_DEGREES = 180.0 / PI;

Clip load(const std::string& stem, ClipKind kind) {
  const std::string file = PACKAGE_FOLDER "/config/motions/" + stem + ".bvh";
  return makeClip(parseBvh(readFile(file, LARGEST_BVH), file), kind, file);
}

MotionStyles march() {
  return {{"march", load("march_walk", ClipKind::WALK), load("march_stand", ClipKind::STAND),
           load("march_turn", ClipKind::TURN), 3.0}};
}

double angle(const ChannelAngles& angles, Channel channel, int side = 0) {
  return angles[indexOf(channel, side)] * TO_DEGREES;
}

// The angles by which scripts/make_motions.py made the files, whose orders of turns differ.
TEST(MotionStyle, ClipsHaveTheAnglesOfTheirFiles) {
  const MotionStyle style = march().front();
  const ChannelAngles strike = style.walk.anglesAt(0.0), middle = style.walk.anglesAt(0.25);
  EXPECT_NEAR(angle(strike, Channel::PELVIS_YAW), -7.0, 1.0);
  EXPECT_NEAR(angle(strike, Channel::TRUNK_YAW), 9.0, 1.5);
  EXPECT_NEAR(angle(strike, Channel::HIP), 32.5, 2.5);
  EXPECT_NEAR(angle(strike, Channel::HIP, 1), -15.5, 2.5);
  EXPECT_NEAR(angle(strike, Channel::SHOULDER), -30.0, 4.0);
  EXPECT_NEAR(angle(strike, Channel::SHOULDER, 1), 30.0, 4.0);
  EXPECT_NEAR(angle(middle, Channel::PELVIS_ROLL), 4.0, 0.6);
  EXPECT_NEAR(angle(style.walk.anglesAt(0.72), Channel::KNEE), 58.0, 5.0);
  const ChannelAngles sway = style.stand.anglesAt(0.25);
  EXPECT_NEAR(angle(sway, Channel::PELVIS_ROLL), 3.0, 0.2);
  EXPECT_NEAR(angle(sway, Channel::ELBOW), 25.0, 1.0);
  EXPECT_NEAR(angle(sway, Channel::ARM_OUT), 10.0, 3.1);
  // Ten degrees of the trunk at 40 degrees per second.
  EXPECT_NEAR(angle(style.turn.anglesAt(0.3), Channel::TRUNK_YAW), 10.0 / (40.0 / TO_DEGREES), 0.5);
}

// S2-35: curves and slopes are continuous at every key and at the end of the cycle.
TEST(MotionStyle, ClipsAreSmoothAllRoundTheCycle) {
  MotionStyles styles = ownStyles();
  styles.push_back(march().front());
  constexpr double STEP = 1e-4;
  for (const MotionStyle& style : styles)
    for (const Clip* clip : {&style.walk, &style.stand, &style.turn})
      for (double phase = 0.0; phase < 1.0 + STEP; phase += STEP) {
        const ChannelAngles a = clip->anglesAt(phase - STEP), b = clip->anglesAt(phase),
                            c = clip->anglesAt(phase + STEP);
        for (std::size_t i = 0; i < CHANNELS; ++i) {
          ASSERT_LT(std::fabs(b[i] - a[i]), 0.003) << style.name << " " << phase << " " << i;
          ASSERT_LT(std::fabs(c[i] - 2.0 * b[i] + a[i]), 1e-5) << style.name << " " << phase;
        }
      }
}

TEST(MotionStyle, PeopleHaveAllStylesByTheirIds) {
  std::set<std::string> names;
  for (std::uint32_t id = 0; id < 40; ++id) {
    names.insert(styleOf(id, ownStyles()).name);
    EXPECT_EQ(styleOf(id, ownStyles()).name, styleOf(id, ownStyles()).name);
  }
  EXPECT_EQ(names.size(), ownStyles().size());
  EXPECT_GE(names.size(), 2U);
}

struct StyledWalk {
  double slip{0.0}, jump{0.0}, stretch{0.0}, lowest{1e9};
  double pelvis_yaw[2] = {9.0, -9.0}, shoulder_yaw[2] = {9.0, -9.0};  ///< least and largest [rad]
};

void addYaw(const Limb& across, double heading, double (&range)[2]) {
  const Vec3 left = across.from - across.to;
  const double yaw = std::remainder(arcTangent(-left.x(), left.y()) - heading, 2.0 * PI);
  range[0] = std::min(range[0], yaw);
  range[1] = std::max(range[1], yaw);
}

StyledWalk walkStyled(double speed, double bend, const MotionStyles& styles, std::uint32_t id) {
  StyledWalk out;
  Walker w;
  w.id = id;
  w.turn_rate = bend;
  const terrain::HeightMap ground;
  Vec3 stood[2];
  bool standing[2] = {false, false};
  Skeleton before;
  for (int i = 0; i < 1200; ++i) {
    w.heading += bend * FRAME;
    const SinCos turn = sinCos(w.heading);
    w.velocity = {speed * turn.cos, speed * turn.sin};
    w.position = w.position + FRAME * w.velocity;
    advanceGait(speed * FRAME, w);
    const Skeleton s = skeletonOf(w, ground, styles, i * FRAME);
    for (std::size_t k = 0; k < PARTS && i > 240; ++k)
      out.jump = std::max(out.jump, length(s[k].to - before[k].to));
    before = s;
    addYaw(limbOf(s, Part::PELVIS), w.heading, out.pelvis_yaw);
    addYaw(limbOf(s, Part::SHOULDERS), w.heading, out.shoulder_yaw);
    for (int side = 0; side < 2 && i > 240; ++side) {
      const Limb& foot = limbOf(s, Part::FOOT, side);
      const Limb& thigh = limbOf(s, Part::THIGH, side);
      out.stretch = std::max(
          out.stretch, std::fabs(length(thigh.to - thigh.from) - Proportions::THIGH * w.height));
      out.lowest = std::min({out.lowest, foot.from.z() - foot.radius, foot.to.z() - foot.radius});
      const bool stands = footPhase(w, side) > 0.1 && footPhase(w, side) < STANCE;
      const Vec3 toe(foot.to.x(), foot.to.y(), 0.0);
      if (stands && !standing[side]) stood[side] = toe;
      if (stands) out.slip = std::max(out.slip, length(toe - stood[side]));
      standing[side] = stands;
    }
  }
  return out;
}

// S2-35: at most 2 cm, whatever the clip.
TEST(MotionStyle, FeetStayWhereTheyStand) {
  MotionStyles all[2] = {ownStyles(), march()};
  for (const MotionStyles& styles : all)
    for (std::uint32_t id = 0; id < 8; ++id)
      for (const double speed : {0.5, 1.35, 1.8})
        for (const double bend : {0.0, 0.4, -0.8}) {
          const StyledWalk found = walkStyled(speed, bend, styles, id);
          const std::string& name = styleOf(id, styles).name;
          EXPECT_LT(found.slip, 0.02) << name << " " << speed << " " << bend;
          EXPECT_LT(found.jump, 6.0 * speed / 120.0 + 0.01) << name << " " << speed;
          EXPECT_GT(found.lowest, -0.03) << name << " " << speed << " " << bend;
          EXPECT_LT(found.stretch, 0.02) << name << " " << speed << " " << bend;
          // Pelvis and shoulders turn against each other.
          EXPECT_GT(found.pelvis_yaw[1] - found.pelvis_yaw[0], 0.03) << name << " " << speed;
          EXPECT_GT(found.shoulder_yaw[1] - found.shoulder_yaw[0], 0.03) << name << " " << speed;
        }
}

TEST(MotionStyle, StandingPeopleMoveAndTheirFeetDoNot) {
  Walker w;
  advanceGait(0.0, w);
  const Skeleton a = skeletonOf(w, terrain::HeightMap(), ownStyles(), 0.0);
  const Skeleton b = skeletonOf(w, terrain::HeightMap(), ownStyles(), 1.3);
  EXPECT_GT(length(limbOf(a, Part::SHOULDERS).from - limbOf(b, Part::SHOULDERS).from), 0.003);
  for (int side = 0; side < 2; ++side)
    EXPECT_LT(length(limbOf(a, Part::FOOT, side).to - limbOf(b, Part::FOOT, side).to), 1e-9);
}

TEST(MotionStyle, TurnsAreMirrored) {
  const MotionStyle& style = ownStyles().front();
  const ChannelAngles left = blendAngles(style, 0.25, 0.0, 1.0, 0.0),
                      right = blendAngles(style, 0.25, 0.0, -1.0, 0.0),
                      none = blendAngles(style, 0.25, 0.0, 0.0, 0.0);
  const auto added = [&](const ChannelAngles& angles, Channel channel, int side = 0) {
    return angles[indexOf(channel, side)] - none[indexOf(channel, side)];
  };
  EXPECT_GT(added(left, Channel::TRUNK_YAW), 0.1);
  EXPECT_DOUBLE_EQ(added(left, Channel::TRUNK_YAW), -added(right, Channel::TRUNK_YAW));
  EXPECT_DOUBLE_EQ(added(left, Channel::ARM_OUT, 1), added(right, Channel::ARM_OUT, 0));
}

TEST(MotionStyle, PeopleWhoStandDoNotMoveInStep) {
  const MotionStyle& style = ownStyles().front();
  std::set<int> tenths;
  for (std::uint32_t id = 1; id <= 40; ++id)
    tenths.insert(static_cast<int>(10.0 * standingSince(id, style) / style.stand_period));
  EXPECT_EQ(*tenths.begin(), 0);
  EXPECT_EQ(*tenths.rbegin(), 9);
  EXPECT_GE(tenths.size(), 8U);
}

// A file with one strike of a heel is one cycle from there to there; the gap between its ends, of
// 20 degrees, is spread over all of it.
TEST(MotionStyle, AFileOfOneCycleIsWrappedWithoutAStep) {
  const std::string file = PACKAGE_FOLDER "/config/motions/march_walk.bvh";
  BvhMotion motion = parseBvh(readFile(file, LARGEST_BVH), file);
  constexpr std::size_t FRAMES = 28, FIRST = 12;
  motion.values.erase(motion.values.begin(),
                      motion.values.begin() + static_cast<long>(FIRST * motion.channels));
  motion.values.resize(FRAMES * motion.channels);
  std::size_t spine = 0;
  for (const BvhMotion::Joint& joint : motion.joints) {
    if (joint.name == "Spine") break;
    spine += joint.channels.size();
  }
  const std::size_t forward = spine + 1;  // its rotation about x
  for (std::size_t i = 0; i < FRAMES; ++i)
    motion.values[i * motion.channels + forward] = 20.0 * static_cast<double>(i) / (FRAMES - 1);
  const Clip clip = makeClip(motion, ClipKind::WALK, file);
  for (std::size_t k = 0; k < Clip::KEYS; ++k)
    EXPECT_NEAR(angle(clip.keys()[k], Channel::TRUNK_PITCH),
                angle(clip.keys()[(k + 1) % Clip::KEYS], Channel::TRUNK_PITCH), 2.0)
        << k;
}

TEST(MotionStyle, RejectsMotionThatDoesNotFit) {
  const BvhMotion no_legs = parseBvh(
      "HIERARCHY ROOT hips { OFFSET 0 0 0 CHANNELS 1 Xrotation } MOTION Frames: 2 Frame Time: 0.1 "
      "0 0",
      "a.bvh");
  try {
    makeClip(no_legs, ClipKind::WALK, "a.bvh");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("a.bvh: no joint 'leftupleg'"), std::string::npos);
  }
  try {
    load("march_walk", ClipKind::TURN);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("is outside 0.1 to 10 rad/s"), std::string::npos)
        << error.what();
  }
  Faults faults;
  MotionStyles styles = ownStyles();
  styles[1].stand_period = 0.0;
  check(styles, faults);
  check(MotionStyles(), faults);
  EXPECT_NE(faults.text().find("style 'brisk': stand_period = 0 s is outside 0.1 to 600 s"),
            std::string::npos)
      << faults.text();
  EXPECT_NE(faults.text().find("styles are 0, allowed are 1 to 16"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::crowd
