// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/tree/modal/modal_tree_state.h"
#include "vegetation_sim/tree/motion/pose.h"
#include "vegetation_sim/wind/sampling/wind_sampler.h"
#include "vegetation_sim/wind/sampling/wind_window.h"

namespace vegetation_sim::forest {

/// Modal amplitudes of a tree at the three stamps of a wind window, by the motion at the middle
/// one, so that central differences give its rates and accelerations. Reuses its memory.
struct ModalSamples {
  const ModalTreeState* modal_state{nullptr};
  std::array<std::vector<double>, 3> amplitude;
  ModalMotion motion;  // at the middle stamp

  void sampleAt(const ModalTreeState& at, Nanoseconds stamp);
};

/// Motion of a joint that is not physical, by central differences: bends [rad], rates [rad/s],
/// accelerations [rad/s^2].
struct JointMotion {
  JointAngles q, rate, acceleration;
};

/// Motion of one tree around a stamp, procedural or modal, from a wind window and the weights of
/// its level at three stamps.
struct ProceduralMotion {
  const Tree& tree;
  const WindWindow& wind;
  std::array<Weights, 3> weights;
  const ModalSamples* modal;  // null: all procedural

  ProceduralMotion(const Tree& tree, const WindWindow& wind, const LevelState& level,
                   const MotionLaw& law, const ModalSamples* modal = nullptr);
  /// Returns the weight of the modes at one of the three stamps.
  double modalShare(std::size_t look) const { return modal ? modalWeight(weights[look]) : 0.0; }
  JointMotion at(int branch) const;
};

/// Motion of many branches of a tree at once, with the bits of ProceduralMotion. Reuses its memory.
class ProceduralMotions {
 public:
  void update(const ProceduralMotion& motion, const std::vector<int>& branches);
  /// Returns the angles of branches[i] at stamp 0, 1 or 2 of the window.
  const JointAngles& angles(std::size_t i, std::size_t look) const { return angles_[look][i]; }
  JointMotion at(std::size_t i) const;

 private:
  WindSampler air_;
  std::array<std::vector<JointAngles>, 3> angles_;
};

/// Motion of a branch that is not physical but carries physical ones (S1-35), tree's frame.
struct CarrierMotion {
  Pose pose;
  Vec3 spin{Vec3::Zero()};          ///< [rad/s]
  Vec3 velocity{Vec3::Zero()};      ///< of its joint [m/s]
  Vec3 spin_rate{Vec3::Zero()};     ///< [rad/s^2]
  Vec3 acceleration{Vec3::Zero()};  ///< [m/s^2]
};
/// @param[in] carriers sorted; all ancestors of each are included.
/// @param motions angles of the carriers, updated.
/// @param[out] out [carriers]
/// @param scratch [3 * carriers] poses, reused from call to call.
void moveCarriers(const Tree& tree, const std::vector<int>& carriers,
                  const ProceduralMotions& motions, std::vector<Pose>& scratch,
                  std::vector<CarrierMotion>& out);

}  // namespace vegetation_sim::forest
