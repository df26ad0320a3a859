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

/// Amplitudes of a tree in modes at the three looks; keeps its memory from look to look.
struct ModalSamples {
  const ModalTreeState* modal_state{nullptr};
  std::array<std::vector<double>, 3> amplitude;

  void sampleAt(const ModalTreeState& at, Nanoseconds stamp);
};

/// Motion of a joint that is not physical at a stamp, by central differences: bends [rad], rates
/// [rad/s], accelerations [rad/s^2].
struct JointMotion {
  JointAngles q, rate, acceleration;
};

/// Motion of one tree around a stamp, procedural or in modes: window and level's weights at its
/// three looks.
struct ProceduralMotion {
  const Tree& tree;
  const WindWindow& wind;
  std::array<Weights, 3> weights;
  const ModalSamples* modal;  // none: all procedural

  ProceduralMotion(const Tree& tree, const WindWindow& wind, const LevelState& level,
                   const MotionLaw& law, const ModalSamples* modal = nullptr);
  /// Weight of the modes at a look.
  double modalShare(std::size_t look) const { return modal ? modalWeight(weights[look]) : 0.0; }
  /// Share of the motion that no law of motion brings about: what compensation starts at (E1).
  double missing() const { return 1.0 - modalShare(1); }
  JointMotion at(int branch) const;
};

/// Motion of many branches of a tree at once: to the bit what ProceduralMotion gives one by one.
/// Keeps its memory from look to look.
class ProceduralMotions {
 public:
  void update(const ProceduralMotion& motion, const std::vector<int>& branches);
  /// Of branches[i], at look 0, 1 or 2.
  const JointAngles& angles(std::size_t i, std::size_t look) const { return angles_[look][i]; }
  JointMotion at(std::size_t i) const;

 private:
  WindSampler air_;
  std::array<std::vector<JointAngles>, 3> angles_;
};

/// How a branch moves that is not physical itself but bears what is (S1-35), tree's frame.
struct CarrierMotion {
  Pose pose;
  Vec3 spin{Vec3::Zero()};          ///< [rad/s]
  Vec3 velocity{Vec3::Zero()};      ///< of its joint [m/s]
  Vec3 spin_rate{Vec3::Zero()};     ///< [rad/s^2]
  Vec3 acceleration{Vec3::Zero()};  ///< [m/s^2]
};
/// @param[in] carriers rising; with each branch all that bear it.
/// @param courses their angles, looked at.
/// @param[out] out [carriers]
/// @param scratch [3 * carriers] poses, kept from call to call.
void moveCarriers(const Tree& tree, const std::vector<int>& carriers,
                  const ProceduralMotions& motions, std::vector<Pose>& scratch,
                  std::vector<CarrierMotion>& out);

}  // namespace vegetation_sim::forest
