// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/dynamics/modes/modal_motion.h"
#include "vegetation_sim/tree/motion/pose.h"
#include "vegetation_sim/wind/sampling/wind_sampler.h"

namespace vegetation_sim::forest {

/// Numbers of oscillators of a tree: its slowest modes, load-dependent vectors for each horizontal
/// direction of the wind, and vertical ones. Wind moves many twigs of a crown alike, which no slow
/// mode does, so vectors represent more than as many modes would (docs/modal.md).
struct ModalDepth {
  int modes{8}, sideways{5}, upwards{1};
  bool quick{true};  ///< one more for each horizontal direction, of the immediate response

  /// Maximum number of oscillators; a pair of modes is never split.
  constexpr std::size_t most() const {
    return static_cast<std::size_t>(modes + 1 + 2 * (sideways + (quick ? 1 : 0)) + upwards);
  }
};
/// For trees whose error with ModalDepth{} exceeds the tolerance. Spans all that ModalDepth{} does.
constexpr ModalDepth FINE_MODES{40, 9, 1, true};

/// A point of a crown; its wind stands for that on the wood and leaves around it.
struct WindPoint {
  Vec3 position{Vec3::Zero()};  ///< at rest, tree's frame [m]
  double drag{0.0};             ///< per air speed, of the wood and leaves that it represents [kg/s]
};

/// Points of a crown and the modal load per velocity at each, [points][3][row], with modes padded
/// to whole vectors [kg/s].
struct WindPoints {
  std::vector<WindPoint> at;
  std::vector<double> push;
};

/// Cache of the wind of one tree: the load of each wave of the breezes, of which only the phase
/// changes.
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

/// Modal model of a tree (N13), between procedural and physical: its slowest modes, load-dependent
/// vectors, and how wind loads them. It is computed from the grown tree in milliseconds, is kept
/// for near trees only and is immutable. Only trees with `swing` joints have one.
class ModalTree {
 public:
  /// @throws InvalidInput for a tree of another joint model.
  ModalTree(const Tree& tree, const Species& species, ModalDepth depth = {});

  /// Load-dependent vectors follow the modes; damping is that of joints and of still air, with
  /// quadratic drag at the reference speed.
  const physics::Modes& modes() const { return modes_; }
  const physics::RotationProbe& probe() const { return probe_; }
  std::size_t size() const { return modes_.size(); }
  std::size_t bytes() const;

  /// Computes the modal loads [modes] of a wind. With linear drag, breezes act on the whole crown
  /// and other winds at the coarse points; with quadratic drag, all act there. `air` belongs to
  /// this tree.
  void loadOf(const wind::Instant& wind, ModalAir& air, std::vector<double>& out) const;
  bool hasQuadraticDrag() const { return drag_ == Drag::QUADRATIC; }
  /// Returns the velocity of the wind at each coarse point as of the last loadOf() [m/s].
  std::vector<Vec3> velocitiesOf(const ModalAir& air) const;
  /// Computes the damping [modes][modes] with quadratic drag, symmetric, in the wind of these
  /// velocities at the coarse points, for amplitudes that change at `rate` [1/s]. With the load of
  /// the wind on wood at rest it gives the drag of the relative velocity.
  void dampingIn(const std::vector<Vec3>& velocity, const std::vector<double>& rate,
                 std::vector<double>& out) const;
  /// Returns the wind at the middle of the crown [m/s].
  Vec3 airOn(const wind::Instant& wind) const;
  /// Returns the velocity that acts on the lever arms as the tree bends, of a wind with this
  /// airOn(). With quadratic drag it is relative to wood whose amplitudes change at `rate`.
  Vec3 leverAir(const Vec3& air, const std::vector<double>& rate) const;
  /// Adds the first-order change of modal loads by bending, for a leverAir() of `velocity`.
  /// Bends beyond MODAL_LIMIT count as that limit; otherwise the load of a storm would grow with
  /// the bend that it causes.
  void bendLevers(const Vec3& velocity, const std::vector<double>& amplitude, ModalAir& air,
                  std::vector<double>& load) const;
  /// Returns the bends of all joints for amplitudes, or their rates for rates; not limited.
  std::vector<JointAngles> bendsOf(const std::vector<double>& amplitude) const;
  /// Returns the amplitudes [modes] nearest to the bends in the energy norm of the springs.
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
  WindPoints coarse_, fine_;       // for all winds; for waves
  std::vector<double> uniform_;    // [3][row] load per velocity of uniform wind [kg/s]
  std::vector<double> levers_;     // [modes][3][row] its change per amplitude
  Vec3 middle_{Vec3::Zero()};      // centre of all drag at rest, tree's frame [m]
  std::vector<double> stiffness_;  // [branches][2]
  std::vector<double> joints_;     // [modes] damping by joints alone
};

/// Returns the bends within the limits of joints (E16): exact up to the knee.
JointAngles limited(const JointAngles& bends);

/// Returns the links of a whole tree, one per branch, as physics has them when all are promoted.
std::vector<physics::Link> chainOf(const Skeleton& skeleton, const Species& species);

}  // namespace vegetation_sim::forest
