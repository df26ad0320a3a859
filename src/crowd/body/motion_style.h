// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim::crowd {

/// Angles of a body [rad]. Those of pelvis, trunk and head are relative to the upright body that
/// looks along its heading: yaw to the left, roll towards the right side, pitch forward. Those of
/// limbs are as in Joints; ARM_OUT lifts the upper arm sideways. The right side follows the left.
enum class Channel : int {
  PELVIS_YAW,
  PELVIS_ROLL,
  TRUNK_YAW,
  TRUNK_ROLL,
  TRUNK_PITCH,
  HEAD_PITCH,
  HIP,
  KNEE,
  ANKLE,
  SHOULDER,
  ELBOW,
  ARM_OUT,
  COUNT = HIP + 12
};
constexpr std::size_t CHANNELS = static_cast<std::size_t>(Channel::COUNT);
constexpr std::size_t ONE_SIDED = 6;                 ///< channels before those of the two sides
constexpr std::size_t SIDE_CHANNELS = 6;             ///< channels of one side
using ChannelAngles = std::array<double, CHANNELS>;  ///< [rad]

/// Returns the index of a channel; `side` is 1 for that of the right side.
inline std::size_t indexOf(Channel channel, int side = 0) {
  return static_cast<std::size_t>(channel) + SIDE_CHANNELS * static_cast<std::size_t>(side);
}

/// A cyclic motion: keys at equal steps of the cycle, which begins when the left heel strikes.
/// Cubic Bezier curves join them, with continuous slopes across the end of the cycle (S2-35).
class Clip {
 public:
  static constexpr std::size_t KEYS = 32;
  using Keys = std::array<ChannelAngles, KEYS>;

  Clip() : keys_{} {}
  explicit Clip(const Keys& keys) : keys_(keys) {}
  const Keys& keys() const { return keys_; }
  /// Returns the angles at a phase in cycles [rad].
  ChannelAngles anglesAt(double phase) const;

 private:
  Keys keys_;
};

/// How a person moves. `turn` is added while the person turns left at 1 rad/s, and mirrored to the
/// right; `stand` has a period in time.
struct MotionStyle {
  std::string name;
  Clip walk, stand, turn;
  double stand_period{4.0};  ///< [s]
};
constexpr std::size_t MOST_STYLES = 16;
constexpr double LARGEST_ANGLE = 3.25;  ///< of a key [rad]; exact in single precision, as sent
using MotionStyles = std::vector<MotionStyle>;

/// The styles of the package, made by formulas: "calm", "brisk" and "tired".
const MotionStyles& ownStyles();
/// Returns the style of an id, equal in every process. There must be one.
const MotionStyle& styleOf(std::uint32_t id, const MotionStyles& styles);
/// Returns how far a person is ahead in the period of standing [s], so that not all move alike.
double standingSince(std::uint32_t id, const MotionStyle& style);
/// Adds a fault for each number of styles, period or angle out of range.
void check(const MotionStyles& styles, Faults& faults);

/// Returns the angles of a person. @param amplitude as in Gait. @param turn_rate to the left
/// [rad/s]. @param seconds any time that rises.
ChannelAngles blendAngles(const MotionStyle& style, double phase, double amplitude,
                          double turn_rate, double seconds);

}  // namespace vegetation_sim::crowd
