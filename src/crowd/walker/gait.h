// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/walker/walker.h"

namespace vegetation_sim::crowd {

/// Joints of one side at a phase of its own cycle, which begins when the heel strikes [rad].
struct Joints {
  double hip{0.0};       ///< thigh from the trunk, flexion positive
  double knee{0.0};      ///< flexion
  double ankle{0.0};     ///< dorsiflexion
  double shoulder{0.0};  ///< upper arm, flexion positive
  double elbow{0.0};     ///< flexion
};

/// Joints of a person who walks (S2-35), `phase` in cycles: key frames joined by cubic Bezier
/// curves whose slopes agree at every key and across the cycle's end.
Joints jointsAt(double phase);
/// Slopes of the same [rad per cycle].
Joints jointRatesAt(double phase);

/// Share of the cycle in which a foot stands.
constexpr double STANCE = 0.6;

/// Way walked in one cycle [m]: grows with the square root of the speed (cadence likewise), in
/// proportion to the body.
double strideLength(double speed, double height);
/// Factor on the joint angles, such that a standing foot goes back as far as the body goes on.
double gaitAmplitude(double speed, double height);

/// Segments of a body, shares of its height (Drillis and Contini 1966).
struct Proportions {
  static constexpr double THIGH = 0.245, SHANK = 0.246, ANKLE = 0.039, HIP_HALF = 0.0525;
  static constexpr double FOOT_FRONT = 0.085, FOOT_BACK = 0.03;  ///< ball and heel from the ankle
  static constexpr double SOLE = 0.018;  ///< half thickness of a foot, over which it rolls
  static constexpr double SHOULDER = 0.818, SHOULDER_HALF = 0.115, UPPER_ARM = 0.172;
  static constexpr double FOREARM = 0.157, NECK = 0.87, HEAD = 0.065;
};

/// One leg in the plane of walking, by its joints alone; forward and up of the hip, shares of the
/// height.
struct LegPose {
  double ankle_forward{0.0}, ankle_up{0.0};
  double pitch{0.0};  ///< of the foot, toes up positive [rad]
  double stand{0.0};  ///< where the flat foot's ball stands that this pose belongs to, forward
  double ankle_height{0.0};  ///< over the ground, of a foot pitched so that stands
};
LegPose legPose(double phase, double amplitude);

/// The ankle from the place where the flat foot's ball stands: the foot rolls over its heel while
/// the toes are up, and over its ball while they are down. Shares of the height.
void rollOver(double pitch, double& forward, double& up);

/// Goes on with the cycle by a way that was walked and sets the feet; the walker is where it is
/// now.
void advanceGait(double way, Walker& walker);

/// Where the flat foot's ball stands or is carried over [m], plan.
Point footPlace(const Walker& walker, int foot);
/// Phase of a foot in its own cycle, 0 to 1.
double footPhase(const Walker& walker, int foot);
double speedOf(const Walker& walker);

}  // namespace vegetation_sim::crowd
