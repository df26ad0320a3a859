// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "dynamics/simd/batch_chain.h"
#include "vegetation_sim/dynamics/chain/linear_chain.h"

namespace vegetation_sim::physics {

/// A chain linearised about rest, on the ground, under loads that swing at one frequency for ever:
/// (K + i w (C + air) - w^2 M) x = f, solved exactly. One pass from the tips to the ground per
/// frequency, one back and forth per load, O(N) each, as articulated bodies go. Own arithmetic:
/// the same bits on each processor.
class HarmonicChain {
 public:
  /// @param[in] grips [links] what holds on to the air; their steady drag counts.
  HarmonicChain(const std::vector<Link>& links, const std::vector<Grip>& grips);

  /// From now on loads swing at `w` [rad/s].
  void setFrequency(double w);
  /// Joint torques [links][2] that go with the cosine and the sine of w t, to the bends that go
  /// with them.
  void answer(std::vector<double>& cosine, std::vector<double>& sine);

  struct Complex {
    double re{0.0}, im{0.0};
  };
  using Column =
      std::array<Complex, 6>;  ///< moves of a joint and turns about it, or what they cost

 private:
  using Block = std::array<Column, 6>;
  struct Node {
    int parent;
    std::array<Vec3, 2> axes;  // of the two bends
    Vec3 offset;               // from the parent's joint
    Block mass, air;           // real: per acceleration, per velocity
    double stiffness, damping;
    // At the frequency that was set.
    std::array<Column, 2> lever;                 // what each bend costs
    std::array<std::array<Complex, 2>, 2> give;  // bends per torque
  };
  void reduce(Node& node, Block& impedance) const;

  std::vector<Node> nodes_;
  std::vector<Block> impedance_;
  std::vector<Column> load_, motion_;
  double w_{0.0};
};

}  // namespace vegetation_sim::physics
