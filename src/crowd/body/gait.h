// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/body/walker.h"

namespace vegetation_sim::crowd {

/// Joint angles of one side at a phase of its own cycle, which begins at heel strike [rad].
struct Joints {
  double hip{0.0};       ///< thigh relative to the trunk, flexion positive
  double knee{0.0};      ///< flexion
  double ankle{0.0};     ///< dorsiflexion
  double shoulder{0.0};  ///< upper arm, flexion positive
  double elbow{0.0};     ///< flexion
};

/// Returns the joints of a walking person (S2-35) at `phase` in cycles: key frames joined by cubic
/// Bezier curves, with continuous slopes at every key and across the cycle's end.
Joints jointsAt(double phase);
/// Returns the derivatives of jointsAt() [rad per cycle].
Joints jointRatesAt(double phase);

/// Share of the cycle during which a foot is on the ground.
constexpr double STANCE = 0.6;

/// Returns the distance walked in one cycle [m]. It grows with the square root of the speed, like
/// the cadence, and in proportion to the body.
double strideLength(double speed, double height);
/// Returns the factor on the joint angles for which a standing foot moves back as fast as the body
/// moves on.
double gaitAmplitude(double speed, double height);

/// Lengths of body segments as shares of the height (Drillis and Contini 1966).
struct Proportions {
  static constexpr double THIGH = 0.245, SHANK = 0.246, ANKLE = 0.039, HIP_HALF = 0.0525;
  static constexpr double FOOT_FRONT = 0.085, FOOT_BACK = 0.03;  ///< ball and heel from the ankle
  static constexpr double SOLE = 0.018;  ///< half thickness of a foot, which rolls over it
  static constexpr double SHOULDER = 0.818, SHOULDER_HALF = 0.115, UPPER_ARM = 0.172;
  static constexpr double FOREARM = 0.157, NECK = 0.87, HEAD = 0.065;
};

/// One leg in the plane of walking from its joints alone: positions forward and up relative to the
/// hip, as shares of the height.
struct LegPose {
  double ankle_forward{0.0}, ankle_up{0.0};
  double pitch{0.0};         ///< pitch of the foot, toes up positive [rad]
  double stand{0.0};         ///< forward position of the flat foot's ball
  double ankle_height{0.0};  ///< height of the ankle above the ground for a foot of this pitch
};
LegPose legPose(double phase, double amplitude);
/// Returns the pose for joints that the amplitude multiplies.
LegPose legPose(const Joints& joints, double amplitude);

/// Moves the ankle relative to the flat foot's ball: the foot rolls over its heel while the toes
/// are up, and over its ball while they are down. Shares of the height.
void rollOver(double pitch, double& forward, double& up);

/// Advances the cycle by a distance that was walked and sets the feet. The walker must be at its
/// new position.
void advanceGait(double way, Walker& walker);

/// Returns the position of the flat foot's ball, planted or in swing [m].
Point footPlace(const Walker& walker, int foot);
/// Returns the phase of a foot in its own cycle, 0 to 1.
double footPhase(const Walker& walker, int foot);
double speedOf(const Walker& walker);

}  // namespace vegetation_sim::crowd
