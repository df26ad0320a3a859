// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/forest/air_sampler.h"
#include "vegetation_sim/forest/pose.h"
#include "vegetation_sim/physics/modal_motion.h"

namespace vegetation_sim::forest {

/// What a tree gets: its slowest modes, vectors for each horizontal direction of the wind, and for
/// the vertical. In crowns wind moves many twigs alike, which no slow mode does: vectors tell more
/// than as many modes (docs/modal.md).
struct ModalDepth {
  int modes{4}, sideways{5}, upwards{1};
};

/// A point of a crown whose wind stands for that on the wood and leaves around it.
struct WindPoint {
  Vec3 position{Vec3::Zero()};  ///< at rest, tree's frame [m]
  double drag{0.0};             ///< per air speed, of all that it stands for [kg/s]
  std::vector<Vec3> push;       ///< [modes] modal load per air velocity [kg/s]
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
  const std::vector<WindPoint>& windPoints() const { return points_; }
  std::size_t size() const { return modes_.size(); }
  std::size_t bytes() const;

  /// Modal loads [modes] of a wind. `air`: scratch.
  void loadOf(const wind::Instant& wind, AirSampler& air, std::vector<double>& out) const;
  /// Bends of all joints for amplitudes, or their rates for rates; not limited.
  std::vector<JointAngles> bendsOf(const std::vector<double>& amplitude) const;
  /// Amplitudes [modes] that come nearest to bends, in the energy of the springs.
  std::vector<double> amplitudesOf(const std::vector<JointAngles>& bends) const;

 private:
  Vec3 foot_;
  Drag drag_;
  double reference_speed_;
  physics::Modes modes_;
  physics::RotationProbe probe_;
  std::vector<WindPoint> points_;
  std::vector<double> stiffness_;  // [branches][2]
};

/// Bends within what joints do (E16): deviation()'s limit, exact up to the knee.
JointAngles limited(const JointAngles& bends);

/// The links of a whole tree, one a branch, as physics has them when all are promoted.
std::vector<physics::Link> chainOf(const Skeleton& skeleton, const Species& species);

}  // namespace vegetation_sim::forest
