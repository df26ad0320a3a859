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
Ankle ankleOf(const Walker& w, int side, const Axes& axes, const terrain::HeightMap& terrain) {
  const double amplitude = gaitAmplitude(speedOf(w), w.height);
  const LegPose own = legPose(footPhase(w, side), amplitude);
  const LegPose other = legPose(footPhase(w, 1 - side), amplitude);
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

struct Body {
  const Walker& walker;
  Axes axes;
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

  void putArm(int side, const Vec3& shoulder, double amplitude) const {
    const double h = walker.height;
    const Joints joints = jointsAt(footPhase(walker, side));
    // An arm is slightly bent and swings more at a higher speed.
    const SinCos upper = sinCos(amplitude * joints.shoulder);
    const SinCos fore = sinCos(amplitude * (joints.shoulder + joints.elbow) + 0.1);
    const double outward = side == 0 ? 0.12 : -0.12;
    const Vec3 elbow =
        shoulder +
        P::UPPER_ARM * h * (upper.sin * axes.front - upper.cos * axes.up + outward * axes.left);
    const Vec3 hand = elbow + P::FOREARM * h * (fore.sin * axes.front - fore.cos * axes.up);
    put(Part::UPPER_ARM, side, shoulder, elbow, 0.026);
    put(Part::FOREARM, side, elbow, hand, 0.022);
  }

  void putTrunk(const Vec3& pelvis, const Vec3& chest, const Vec3& lean) const {
    const double h = walker.height;
    const Vec3 neck = pelvis + (P::NECK - P::THIGH - P::SHANK - P::ANKLE) * h * lean;
    put(Part::PELVIS, 0, pelvis + 0.04 * h * axes.left, pelvis - 0.04 * h * axes.left, 0.062);
    put(Part::CHEST, 0, pelvis + 0.05 * h * lean, chest - 0.03 * h * lean, 0.078);
    put(Part::SHOULDERS, 0, chest + 0.075 * h * axes.left, chest - 0.075 * h * axes.left, 0.05);
    put(Part::NECK, 0, chest, neck, 0.032);
    put(Part::HEAD, 0, neck, neck + 0.06 * h * lean, P::HEAD);
  }
};

}  // namespace

Skeleton skeletonOf(const Walker& w, const terrain::HeightMap& terrain) {
  Skeleton out;
  const Axes axes = axesOf(w);
  const Body body{w, axes, out};
  const double h = w.height, leg = STRETCHED * (P::THIGH + P::SHANK) * h;
  const Ankle ankles[2] = {ankleOf(w, 0, axes, terrain), ankleOf(w, 1, axes, terrain)};
  Vec3 pelvis(w.position.x, w.position.y, 0.0);
  const Vec3 hips[2] = {pelvis + P::HIP_HALF * h * axes.left, pelvis - P::HIP_HALF * h * axes.left};
  const double ground = terrain.height(w.position.x, w.position.y);
  pelvis.z() = ground + (P::THIGH + P::SHANK + P::ANKLE) * h;
  for (int side = 0; side < 2; ++side)
    pelvis.z() = std::min(pelvis.z(), reachOf(ankles[side].place, hips[side], leg));
  for (int side = 0; side < 2; ++side)
    body.putLeg(side, Vec3(hips[side].x(), hips[side].y(), pelvis.z()), ankles[side]);
  const SinCos tilt = sinCos(std::min(0.15, LEAN * speedOf(w)) +
                             LEAN_ON_SLOPE * slopeAt(w.position, axes, terrain));
  const Vec3 lean = tilt.sin * axes.front + tilt.cos * axes.up;
  const Vec3 chest = pelvis + (P::SHOULDER - P::THIGH - P::SHANK - P::ANKLE) * h * lean;
  body.putTrunk(pelvis, chest, lean);
  const double amplitude = gaitAmplitude(speedOf(w), h);
  for (int side = 0; side < 2; ++side)
    body.putArm(side, chest + (side == 0 ? 1.0 : -1.0) * P::SHOULDER_HALF * h * axes.left,
                amplitude);
  return out;
}

}  // namespace vegetation_sim::crowd
