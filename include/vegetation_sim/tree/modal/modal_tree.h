// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/modal/modal_motion.h"
#include "vegetation_sim/tree/motion/pose.h"
#include "vegetation_sim/wind/sampling/wind_sampler.h"

namespace vegetation_sim::forest {

/// What a tree gets: its slowest modes, vectors for each horizontal direction of the wind, and for
/// the vertical. In crowns wind moves many twigs alike, which no slow mode does: vectors tell more
/// than as many modes (docs/modal.md).
struct ModalDepth {
  int modes{8}, sideways{5}, upwards{1};
  bool quick{true};  ///< one more for each horizontal direction: how the tree gives way at once

  /// Most oscillators that it makes: a pair of modes is never cut.
  constexpr std::size_t most() const {
    return static_cast<std::size_t>(modes + 1 + 2 * (sideways + (quick ? 1 : 0)) + upwards);
  }
};
/// For trees of which these leave more than is tolerated. It spans all that ModalDepth{} does.
constexpr ModalDepth FINE_MODES{40, 9, 1, true};

/// A point of a crown whose wind stands for that on the wood and leaves around it.
struct WindPoint {
  Vec3 position{Vec3::Zero()};  ///< at rest, tree's frame [m]
  double drag{0.0};             ///< per air speed, of all that it stands for [kg/s]
};

/// Points of a crown, and what the air there does: modal load per velocity [points][3][row], the
/// modes filled up to whole vectors [kg/s].
struct WindPoints {
  std::vector<WindPoint> at;
  std::vector<double> push;
};

/// What looks at the wind of one tree keep from look to look: what each wave of the breezes does to
/// it, which changes with the wave's phase only.
struct ModalAir {
  WindSampler sampler;
  std::vector<Vec3> waves;       ///< [turns/m]
  std::vector<double> push;      ///< [waves][cosine, sine][3][row] as WindPoints::push
  std::vector<Vec3> velocities;  ///< scratch

  std::size_t bytes() const {
    return sizeof(double) * push.capacity() +
           sizeof(Vec3) * (waves.capacity() + velocities.capacity());
  }
};

/// A tree between procedural and physical (N13): its slowest modes, what a wind from each side
/// moves beyond them, and how wind loads them. Computed from the grown tree in milliseconds, kept
/// for near trees only; never changes. Trees whose joints bend (`swing`) only.
class ModalTree {
 public:
  /// @throws InvalidInput for a tree of another joint model.
  ModalTree(const Tree& tree, const Species& species, ModalDepth depth = {});

  /// Load-dependent vectors follow the modes; dampers are the joints' and the air's.
  const physics::Modes& modes() const { return modes_; }
  const physics::RotationProbe& probe() const { return probe_; }
  std::size_t size() const { return modes_.size(); }
  std::size_t bytes() const;

  /// Modal loads [modes] of a wind. Linear drag: breezes on all of the crown, the rest at
  /// a few points; quadratic: all there. `air`: of this tree only.
  void loadOf(const wind::Instant& wind, ModalAir& air, std::vector<double>& out) const;
  /// The air that turns levers as the tree bends, at the middle of the crown [m/s].
  Vec3 airOn(const wind::Instant& wind) const;
  /// Adds to modal loads what bending changes in them in a wind whose airOn() is `velocity`, to the
  /// first order. What is bent beyond MODAL_LIMIT counts as bent so far, whatever the wind: else a
  /// storm would bend on what it bends.
  void bendLevers(const Vec3& velocity, const std::vector<double>& amplitude, ModalAir& air,
                  std::vector<double>& load) const;
  /// Bends of all joints for amplitudes, or their rates for rates; not limited.
  std::vector<JointAngles> bendsOf(const std::vector<double>& amplitude) const;
  /// Amplitudes [modes] that come nearest to bends, in the energy of the springs.
  std::vector<double> amplitudesOf(const std::vector<JointAngles>& bends) const;

 private:
  void updateWaves(const wind::Instant& wind, ModalAir& air) const;
  void pushOf(const Vec3& wave, double* out) const;
  void velocitiesAt(const wind::Instant& wind, ModalAir& air) const;

  Vec3 foot_;
  Drag drag_;
  double reference_speed_;
  physics::Modes modes_;
  physics::RotationProbe probe_;
  WindPoints coarse_, fine_;       // for all winds, for waves
  std::vector<double> uniform_;    // [3][row] load per velocity of the same air everywhere [kg/s]
  std::vector<double> levers_;     // [modes][3][row] its change per amplitude
  Vec3 middle_{Vec3::Zero()};      // of all drag, at rest, tree's frame [m]
  std::vector<double> stiffness_;  // [branches][2]
};

/// Bends within what joints do (E16): deviation()'s limit, exact up to the knee.
JointAngles limited(const JointAngles& bends);

/// The links of a whole tree, one a branch, as physics has them when all are promoted.
std::vector<physics::Link> chainOf(const Skeleton& skeleton, const Species& species);

}  // namespace vegetation_sim::forest
