// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "dynamics/batch_step/batch_chain.h"
#include "vegetation_sim/dynamics/chain/linear_chain.h"

namespace vegetation_sim::physics {

/// A chain linearised about rest, on the ground, under loads that oscillate at one frequency for
/// ever: (K + i w (C + air) - w^2 M) x = f, solved exactly. It takes one pass from the tips to the
/// ground per frequency and one pass in each direction per load, O(N) each, like the
/// articulated-body algorithm. It uses its own complex arithmetic, for the same bits on each
/// processor.
class HarmonicChain {
 public:
  /// @param[in] grips [links] are the places where air acts; their linear drag counts.
  HarmonicChain(const std::vector<Link>& links, const std::vector<Grip>& grips);

  /// Sets the angular frequency `w` of the loads [rad/s].
  void setFrequency(double w);
  /// Replaces the joint torques [links][2] of the cosine and the sine of w t by the bends that they
  /// cause.
  void solve(std::vector<double>& cosine, std::vector<double>& sine);

  struct Complex {
    double re{0.0}, im{0.0};
  };
  using Column =
      /// displacement of a joint and turn about it, or the corresponding force and torque
      std::array<Complex, 6>;

 private:
  using Block = std::array<Column, 6>;
  struct Node {
    int parent;
    std::array<Vec3, 2> axes;  // of the two bends
    Vec3 offset;               // from the parent's joint
    Block mass, air;           // real: per acceleration, per velocity
    double stiffness, damping;
    // Values at the frequency that was set.
    std::array<Column, 2> lever;                 // impedance of each bend
    std::array<std::array<Complex, 2>, 2> give;  // bends per torque
  };
  void reduce(Node& node, Block& impedance) const;

  std::vector<Node> nodes_;
  std::vector<Block> impedance_;
  std::vector<Column> load_, motion_;
  double w_{0.0};
};

}  // namespace vegetation_sim::physics
