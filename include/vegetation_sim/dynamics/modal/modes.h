// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "vegetation_sim/dynamics/chain/linear_chain.h"

namespace vegetation_sim::physics {

/// Shapes in which a chain swings about rest, each an oscillator of its own of unit modal mass:
/// a'' + damping a' + frequency^2 a = shape . f (N13). Bends are the sum of a times shape.
struct Modes {
  std::size_t length{0};          ///< of a shape: 2 a link
  std::vector<double> frequency;  ///< [modes] [rad/s]
  std::vector<double> damping;    ///< [modes] rate [1/s]
  std::vector<double> shape;      ///< [modes][links][2]
  int passes{0};                  ///< of M x that it took to find them

  std::size_t size() const { return frequency.size(); }
  const double* shapeOf(std::size_t mode) const { return shape.data() + mode * length; }
  std::size_t bytes() const;
};

/// Relative residual to which modes are found: at 1e-2 some are skipped.
constexpr double MODE_TOLERANCE = 1e-4;
/// Two bending modes whose frequencies are nearer than this are a pair, and never cut.
constexpr double PAIR_GAP = 0.02;

/// The `count` slowest modes of K phi = w^2 M phi, one more where that would cut a pair, all where
/// there are no more: block Lanczos of two vectors, so that equal modes are found both, with full
/// reorthogonalisation. Each pass is O(N).
Modes slowestModes(LinearChain& chain, int count);

/// Rate at which the joints' dampers slow an oscillator of this shape of unit modal mass [1/s].
double modalDamping(const LinearChain& chain, const double* shape);

/// Joint torques [N m] of a load, and how many Krylov vectors to draw from it. These go from its
/// steady answer towards slow motion; `quick` is one more, of fast motion (see below), or empty.
struct LoadShape {
  std::vector<double> torque;
  int depth{1};
  std::vector<double> quick{};
};

/// Direction of the bends of a chain at rest when a load [2 a link] has acted for `h` seconds:
/// (M + h C + h^2 K)^-1 times the load, in one O(N) pass (N13).
std::vector<double> quickAnswer(const std::vector<Link>& links, const std::vector<double>& torque,
                                double h);

/// Adds what loads move and the modes leave out: the vectors of all loads together, made free of
/// the modes, as further oscillators at their Rayleigh frequencies. From depth 1 on the answer to a
/// steady load is exact: the static correction, without its jump. With a quick vector so is,
/// nearly, what a load does in the first moments.
void addLoadVectors(LinearChain& chain, const std::vector<LoadShape>& loads, Modes& modes);

}  // namespace vegetation_sim::physics
