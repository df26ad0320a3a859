// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/motion_style.h"

#include <algorithm>
#include <cmath>

#include "crowd/body/gait.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::crowd {
namespace {

constexpr std::uint64_t STYLES = 0x7374796C;  // key of the random numbers
constexpr double FASTEST_TURN = 1.5;          // beyond it a turn looks alike [rad/s]

/// Sizes of the movements of an own style [rad], and factors on the joints of a limb.
struct Manner {
  const char* name;
  double pelvis_yaw, pelvis_roll, trunk_yaw, trunk_pitch, head_pitch;
  double arms, elbows, arm_out, lift;
  double stand_sway, period;
};
// Rotations of pelvis and shoulders in natural walking are 5 to 10 degrees (Murray, Drought and
// Kory 1964); the pelvis sinks by some 4 degrees on the side of the swinging leg.
constexpr Manner MANNERS[] = {
    {"calm", 0.09, 0.06, 0.11, 0.02, 0.02, 0.9, 1.0, 0.12, 1.0, 0.015, 5.0},
    {"brisk", 0.14, 0.08, 0.17, 0.06, -0.02, 1.35, 1.7, 0.16, 1.08, 0.01, 3.5},
    {"tired", 0.05, 0.04, 0.05, 0.16, 0.22, 0.5, 0.7, 0.09, 0.94, 0.03, 7.0}};

void putSide(const Manner& manner, double phase, int side, ChannelAngles& out) {
  const Joints joints = jointsAt(phase + 0.5 * side);
  out[indexOf(Channel::HIP, side)] = joints.hip;
  out[indexOf(Channel::KNEE, side)] = manner.lift * joints.knee;
  out[indexOf(Channel::ANKLE, side)] = joints.ankle;
  out[indexOf(Channel::SHOULDER, side)] = manner.arms * joints.shoulder;
  out[indexOf(Channel::ELBOW, side)] = manner.elbows * joints.elbow;
  out[indexOf(Channel::ARM_OUT, side)] = manner.arm_out;
}

// At the strike of the left heel the left hip and the right shoulder are in front.
ChannelAngles walkingAt(const Manner& manner, double phase) {
  ChannelAngles out{};
  const SinCos turn = sinCosTurns(phase), twice = sinCosTurns(2.0 * phase);
  out[indexOf(Channel::PELVIS_YAW)] = -manner.pelvis_yaw * turn.cos;
  out[indexOf(Channel::PELVIS_ROLL)] = manner.pelvis_roll * turn.sin;
  out[indexOf(Channel::TRUNK_YAW)] = manner.trunk_yaw * turn.cos;
  out[indexOf(Channel::TRUNK_ROLL)] = -0.3 * manner.pelvis_roll * turn.sin;
  out[indexOf(Channel::TRUNK_PITCH)] = manner.trunk_pitch * (1.0 + 0.15 * twice.cos);
  out[indexOf(Channel::HEAD_PITCH)] = manner.head_pitch;
  for (int side = 0; side < 2; ++side) putSide(manner, phase, side, out);
  return out;
}

// The weight moves from one leg to the other and back.
ChannelAngles standingAt(const Manner& manner, double phase) {
  ChannelAngles out{};
  const SinCos turn = sinCosTurns(phase), twice = sinCosTurns(2.0 * phase);
  out[indexOf(Channel::PELVIS_ROLL)] = 2.0 * manner.stand_sway * turn.sin;
  out[indexOf(Channel::PELVIS_YAW)] = manner.stand_sway * turn.cos;
  out[indexOf(Channel::TRUNK_ROLL)] = -manner.stand_sway * turn.sin;
  out[indexOf(Channel::TRUNK_YAW)] = 2.0 * manner.stand_sway * turn.cos;
  out[indexOf(Channel::TRUNK_PITCH)] = manner.trunk_pitch + 0.4 * manner.stand_sway * twice.sin;
  out[indexOf(Channel::HEAD_PITCH)] = manner.head_pitch + manner.stand_sway * twice.cos;
  for (int side = 0; side < 2; ++side) {
    out[indexOf(Channel::SHOULDER, side)] = 0.04 + manner.stand_sway * twice.sin;
    out[indexOf(Channel::ELBOW, side)] = 0.12 * manner.elbows;
    out[indexOf(Channel::ARM_OUT, side)] = manner.arm_out;
  }
  return out;
}

// Head and shoulders lead, the pelvis follows, and the body leans into the curve.
ChannelAngles turningAt(const Manner& manner, double phase) {
  ChannelAngles out{};
  const double pulse = 1.0 + 0.2 * sinCosTurns(2.0 * phase).cos;
  out[indexOf(Channel::PELVIS_YAW)] = 0.8 * manner.pelvis_yaw * pulse;
  out[indexOf(Channel::TRUNK_YAW)] = 1.6 * manner.trunk_yaw * pulse;
  out[indexOf(Channel::TRUNK_ROLL)] = -0.08;
  out[indexOf(Channel::ARM_OUT, 1)] = 0.06;
  return out;
}

template <class Angles>
Clip clipOf(const Manner& manner, const Angles& angles) {
  Clip::Keys keys;
  for (std::size_t i = 0; i < Clip::KEYS; ++i)
    keys[i] = angles(manner, static_cast<double>(i) / Clip::KEYS);
  return Clip(keys);
}

// Yaw and roll of the middle of the body change their sign in a mirror, and the sides change place.
double mirrored(const ChannelAngles& angles, std::size_t channel) {
  if (channel <= indexOf(Channel::TRUNK_ROLL)) return -angles[channel];
  if (channel < ONE_SIDED) return angles[channel];
  return angles[channel < ONE_SIDED + SIDE_CHANNELS ? channel + SIDE_CHANNELS
                                                    : channel - SIDE_CHANNELS];
}

}  // namespace

ChannelAngles Clip::anglesAt(double phase) const {
  const double at = (phase - std::floor(phase)) * KEYS;
  const auto first = std::min(static_cast<std::size_t>(at), KEYS - 1);
  const double u = at - static_cast<double>(first), w = 1.0 - u;
  const ChannelAngles &before = keys_[(first + KEYS - 1) % KEYS], &from = keys_[first],
                      &to = keys_[(first + 1) % KEYS], &after = keys_[(first + 2) % KEYS];
  ChannelAngles out;
  for (std::size_t i = 0; i < CHANNELS; ++i) {
    const double p1 = from[i] + (to[i] - before[i]) / 6.0, p2 = to[i] - (after[i] - from[i]) / 6.0;
    out[i] = w * w * w * from[i] + 3.0 * u * w * (w * p1 + u * p2) + u * u * u * to[i];
  }
  return out;
}

const MotionStyles& ownStyles() {
  static const MotionStyles OWN = [] {
    MotionStyles out;
    for (const Manner& manner : MANNERS)
      out.push_back({manner.name, clipOf(manner, walkingAt), clipOf(manner, standingAt),
                     clipOf(manner, turningAt), manner.period});
    return out;
  }();
  return OWN;
}

const MotionStyle& styleOf(std::uint32_t id, const MotionStyles& styles) {
  return styles[Random(id).child(STYLES).bits(0) % styles.size()];
}

double standingSince(std::uint32_t id, const MotionStyle& style) {
  return style.stand_period * Random(id).child(STYLES).uniform(1);
}

void check(const MotionStyles& styles, Faults& faults) {
  if (styles.empty() || styles.size() > MOST_STYLES)
    faults.add("styles are " + std::to_string(styles.size()) + ", allowed are 1 to " +
               std::to_string(MOST_STYLES));
  for (const MotionStyle& style : styles) {
    FieldChecker checker("style " + inQuotes(style.name) + ": ", faults);
    double period = style.stand_period;
    checker.number("stand_period", period, "s", {0.1, 600.0});
    for (const Clip* clip : {&style.walk, &style.stand, &style.turn})
      for (const ChannelAngles& key : clip->keys())
        for (double angle : key)
          checker.number("angle", angle, "rad", {-LARGEST_ANGLE, LARGEST_ANGLE});
  }
}

ChannelAngles blendAngles(const MotionStyle& style, double phase, double amplitude,
                          double turn_rate, double seconds) {
  const ChannelAngles walk = style.walk.anglesAt(phase), turn = style.turn.anglesAt(phase);
  const ChannelAngles stand = style.stand.anglesAt(seconds / style.stand_period);
  const double turning = std::clamp(turn_rate, -FASTEST_TURN, FASTEST_TURN);
  const double left = std::max(0.0, turning), right = std::max(0.0, -turning);
  ChannelAngles out;
  for (std::size_t i = 0; i < CHANNELS; ++i)
    out[i] =
        stand[i] + amplitude * (walk[i] - stand[i]) + left * turn[i] + right * mirrored(turn, i);
  return out;
}

}  // namespace vegetation_sim::crowd
