// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/body_skeleton.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::crowd {
namespace {

using P = Proportions;

// Largest share of a leg's length; a straight leg has no direction of bending.
constexpr double STRETCHED = 0.999;
constexpr double LEAN = 0.04;  // lean of the trunk per m/s [rad]
// People lean forward uphill and back downhill, far less than the ground does (Leroux, Fung and
// Barbeau 2002): share of the slope's angle.
constexpr double LEAN_ON_SLOPE = 0.3;

// Directions of a walker's body.
struct Axes {
  Vec3 front, left, up{Vec3::UnitZ()};
};

struct Ankle {
  Vec3 place;
  double pitch;
};

Axes axesOf(const Walker& w) {
  const SinCos turn = sinCos(w.heading);
  return {Vec3(turn.cos, turn.sin, 0.0), Vec3(-turn.sin, turn.cos, 0.0), Vec3::UnitZ()};
}

// Returns the slope of the ground around a place along the walker's front [rad], uphill positive.
// It has no steps where facets meet.
double slopeAt(const Point& place, const Axes& axes, const terrain::HeightMap& terrain) {
  if (terrain.isFlat()) return 0.0;
  constexpr double HALF = 0.15;  // length of a foot [m]
  const double x = HALF * axes.front.x(), y = HALF * axes.front.y();
  const double rise =
      terrain.height(place.x + x, place.y + y) - terrain.height(place.x - x, place.y - y);
  return arcTangent(rise, 2.0 * HALF);
}

// Returns the axes turned about the left one, so that the front rises by an angle.
Axes raised(const Axes& axes, double angle) {
  const SinCos turn = sinCos(angle);
  return {turn.cos * axes.front + turn.sin * axes.up, axes.left,
          turn.cos * axes.up - turn.sin * axes.front};
}

// A planted foot rolls on the slope of its own ground. A swinging foot is as much higher than the
// other as the joints lift it.
Ankle ankleOf(const Walker& w, int side, const Axes& axes, const LegPose (&legs)[2],
              const terrain::HeightMap& terrain) {
  const LegPose &own = legs[side], &other = legs[1 - side];
  double forward, up;
  rollOver(own.pitch, forward, up);
  if (footPhase(w, side) >= STANCE) {
    // Height of the pelvis by either leg; the difference is the lift of the foot.
    const double pelvis =
        std::max(own.ankle_height - own.ankle_up, other.ankle_height - other.ankle_up);
    const double phase = footPhase(w, side), fade = 0.08;
    up += smoothStep((phase - STANCE) / fade) * smoothStep((1.0 - phase) / fade) *
          std::max(0.0, pelvis + own.ankle_up - up);
  }
  const Point ball = footPlace(w, side);
  Vec3 place(ball.x, ball.y, terrain.height(ball.x, ball.y));
  const double slope = slopeAt(ball, axes, terrain);
  const Axes ground = raised(axes, slope);
  place += w.height * (forward * ground.front + up * ground.up);
  return {place, own.pitch + slope};
}

// Returns the highest pelvis from which a leg reaches its ankle.
double reachOf(const Vec3& ankle, const Vec3& hip, double leg) {
  const double x = ankle.x() - hip.x(), y = ankle.y() - hip.y();
  return ankle.z() + std::sqrt(std::max(0.0, leg * leg - x * x - y * y));
}

// Returns the knee, in front of the line from hip to ankle.
Vec3 kneeOf(const Vec3& hip, const Vec3& ankle, const Vec3& front, double thigh, double shank) {
  const Vec3 span = ankle - hip;
  const double size = std::max(1e-6, length(span));
  const double reach = std::min(size, STRETCHED * (thigh + shank));
  const double along = (thigh * thigh - shank * shank + reach * reach) / (2.0 * reach);
  const double out = std::sqrt(std::max(0.0, thigh * thigh - along * along));
  const Vec3 down = span / size, side = front - dot(front, down) * down;
  return hip + along * down + (out / std::max(1e-6, length(side))) * side;
}

/// Angles of an arm from the vertical [rad]; `outward` is its share to the left.
struct ArmPose {
  double upper, fore, outward;
};

/// A posture is decided by the gait or a style.
struct Posture {
  LegPose legs[2];
  ArmPose arms[2];
  Axes pelvis, chest;
  Vec3 spine, head;
};

struct Body {
  const Walker& walker;
  Axes axes;
  const Posture& posture;
  Skeleton& out;

  void put(Part part, int side, const Vec3& from, const Vec3& to, double radius) const {
    out[static_cast<std::size_t>(part) + static_cast<std::size_t>(side)] = {from, to,
                                                                            radius * walker.height};
  }

  void putLeg(int side, const Vec3& hip, const Ankle& ankle) const {
    const double h = walker.height;
    const Vec3 knee = kneeOf(hip, ankle.place, axes.front, P::THIGH * h, P::SHANK * h);
    const SinCos turn = sinCos(ankle.pitch);
    const Vec3 along = turn.cos * axes.front + turn.sin * axes.up;
    const Vec3 below = turn.sin * axes.front - turn.cos * axes.up;
    const Vec3 sole = ankle.place + (P::ANKLE - P::SOLE) * h * below;
    put(Part::THIGH, side, hip, knee, 0.044);
    put(Part::SHANK, side, knee, ankle.place, 0.029);
    put(Part::FOOT, side, sole - P::FOOT_BACK * h * along, sole + P::FOOT_FRONT * h * along,
        P::SOLE);
  }

  void putArm(int side, const Vec3& shoulder) const {
    const double h = walker.height;
    const ArmPose& arm = posture.arms[side];
    const SinCos upper = sinCos(arm.upper), fore = sinCos(arm.fore);
    const Vec3 elbow =
        shoulder +
        P::UPPER_ARM * h * (upper.sin * axes.front - upper.cos * axes.up + arm.outward * axes.left);
    const Vec3 hand = elbow + P::FOREARM * h * (fore.sin * axes.front - fore.cos * axes.up);
    put(Part::UPPER_ARM, side, shoulder, elbow, 0.026);
    put(Part::FOREARM, side, elbow, hand, 0.022);
  }

  void putTrunk(const Vec3& pelvis, const Vec3& chest) const {
    const double h = walker.height;
    const Vec3 &lean = posture.spine, &across = posture.pelvis.left, &wide = posture.chest.left;
    const Vec3 neck = pelvis + (P::NECK - P::THIGH - P::SHANK - P::ANKLE) * h * lean;
    put(Part::PELVIS, 0, pelvis + 0.04 * h * across, pelvis - 0.04 * h * across, 0.062);
    put(Part::CHEST, 0, pelvis + 0.05 * h * lean, chest - 0.03 * h * lean, 0.078);
    put(Part::SHOULDERS, 0, chest + 0.075 * h * wide, chest - 0.075 * h * wide, 0.05);
    put(Part::NECK, 0, chest, neck, 0.032);
    put(Part::HEAD, 0, neck, neck + 0.06 * h * posture.head, P::HEAD);
  }
};

// Returns the lean of the trunk to the front by speed and slope [rad].
double leanOf(const Walker& w, const Axes& axes, const terrain::HeightMap& terrain) {
  return std::min(0.15, LEAN * speedOf(w)) + LEAN_ON_SLOPE * slopeAt(w.position, axes, terrain);
}

Posture plainPosture(const Walker& w, const Axes& axes, const terrain::HeightMap& terrain) {
  Posture out;
  const double amplitude = gaitAmplitude(speedOf(w), w.height);
  for (int side = 0; side < 2; ++side) {
    const Joints joints = jointsAt(footPhase(w, side));
    out.legs[side] = legPose(joints, amplitude);
    // An arm is slightly bent and swings more at a higher speed.
    out.arms[side] = {amplitude * joints.shoulder,
                      amplitude * (joints.shoulder + joints.elbow) + 0.1, side == 0 ? 0.12 : -0.12};
  }
  const SinCos tilt = sinCos(leanOf(w, axes, terrain));
  out.pelvis = out.chest = axes;
  out.spine = out.head = tilt.sin * axes.front + tilt.cos * axes.up;
  return out;
}

// Returns the axes turned to the left, then rolled to the right.
Axes turned(const Axes& axes, double yaw, double roll) {
  const SinCos turn = sinCos(yaw), tilt = sinCos(roll);
  const Vec3 front = turn.cos * axes.front + turn.sin * axes.left;
  const Vec3 left = turn.cos * axes.left - turn.sin * axes.front;
  return {front, tilt.cos * left + tilt.sin * axes.up, tilt.cos * axes.up - tilt.sin * left};
}

// Returns a direction that leans to the front and to the right.
Vec3 leaning(const Axes& axes, double pitch, double roll) {
  const SinCos forward = sinCos(pitch), aside = sinCos(roll);
  return forward.sin * axes.front + forward.cos * (aside.cos * axes.up - aside.sin * axes.left);
}

ArmPose armOf(const ChannelAngles& angles, int side) {
  const double shoulder = angles[indexOf(Channel::SHOULDER, side)];
  const double outward = sinCos(angles[indexOf(Channel::ARM_OUT, side)]).sin;
  return {shoulder, shoulder + angles[indexOf(Channel::ELBOW, side)],
          side == 0 ? outward : -outward};
}

// A foot stands on its ball whatever motion data say: its toes come down in the first tenth of the
// cycle and rise again when it swings.
LegPose keepToesDown(const Joints& joints, double phase) {
  Joints kept = joints;
  const double pitch = joints.hip - joints.knee + joints.ankle;
  const double toes_up =
      phase < STANCE ? 1.0 - smoothStep(phase / 0.1) : smoothStep((phase - STANCE) / 0.25);
  if (pitch > 0.0) kept.ankle -= (1.0 - toes_up) * pitch;
  return legPose(kept, 1.0);
}

Posture styledPosture(const Walker& w, const Axes& axes, const terrain::HeightMap& terrain,
                      const ChannelAngles& angles) {
  Posture out;
  for (int side = 0; side < 2; ++side) {
    Joints joints;
    joints.hip = angles[indexOf(Channel::HIP, side)];
    joints.knee = angles[indexOf(Channel::KNEE, side)];
    joints.ankle = angles[indexOf(Channel::ANKLE, side)];
    out.legs[side] = keepToesDown(joints, footPhase(w, side));
    out.arms[side] = armOf(angles, side);
  }
  const double pitch = leanOf(w, axes, terrain) + angles[indexOf(Channel::TRUNK_PITCH)];
  const double roll = angles[indexOf(Channel::TRUNK_ROLL)];
  out.pelvis =
      turned(axes, angles[indexOf(Channel::PELVIS_YAW)], angles[indexOf(Channel::PELVIS_ROLL)]);
  out.chest = turned(axes, angles[indexOf(Channel::TRUNK_YAW)], roll);
  out.spine = leaning(axes, pitch, roll);
  out.head = leaning(axes, leanOf(w, axes, terrain) + angles[indexOf(Channel::HEAD_PITCH)], 0.0);
  return out;
}

Skeleton buildBody(const Walker& w, const Axes& axes, const Posture& posture,
                   const terrain::HeightMap& terrain) {
  Skeleton out;
  const Body body{w, axes, posture, out};
  const double h = w.height, leg = STRETCHED * (P::THIGH + P::SHANK) * h;
  const Ankle ankles[2] = {ankleOf(w, 0, axes, posture.legs, terrain),
                           ankleOf(w, 1, axes, posture.legs, terrain)};
  Vec3 pelvis(w.position.x, w.position.y, 0.0);
  const Vec3 half = P::HIP_HALF * h * posture.pelvis.left;
  const Vec3 hips[2] = {pelvis + half, pelvis - half};
  const double ground = terrain.height(w.position.x, w.position.y);
  pelvis.z() = ground + (P::THIGH + P::SHANK + P::ANKLE) * h;
  for (int side = 0; side < 2; ++side)
    pelvis.z() =
        std::min(pelvis.z(), reachOf(ankles[side].place, hips[side], leg) - hips[side].z());
  for (int side = 0; side < 2; ++side)
    body.putLeg(side, Vec3(hips[side].x(), hips[side].y(), pelvis.z() + hips[side].z()),
                ankles[side]);
  const Vec3 chest = pelvis + (P::SHOULDER - P::THIGH - P::SHANK - P::ANKLE) * h * posture.spine;
  body.putTrunk(pelvis, chest);
  for (int side = 0; side < 2; ++side)
    body.putArm(side, chest + (side == 0 ? 1.0 : -1.0) * P::SHOULDER_HALF * h * posture.chest.left);
  return out;
}

}  // namespace

Skeleton skeletonOf(const Walker& w, const terrain::HeightMap& terrain) {
  const Axes axes = axesOf(w);
  return buildBody(w, axes, plainPosture(w, axes, terrain), terrain);
}

Skeleton skeletonOf(const Walker& w, const terrain::HeightMap& terrain, const MotionStyles& styles,
                    double seconds) {
  const Axes axes = axesOf(w);
  const MotionStyle& style = styleOf(w.id, styles);
  const ChannelAngles angles =
      blendAngles(style, footPhase(w, 0), gaitAmplitude(speedOf(w), w.height), w.turn_rate,
                  seconds + standingSince(w.id, style));
  return buildBody(w, axes, styledPosture(w, axes, terrain, angles), terrain);
}

}  // namespace vegetation_sim::crowd
