// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "vegetation_sim/dynamics/chain/linear_chain.h"

namespace vegetation_sim::physics {

/// Mode shapes of a chain about rest, each an oscillator of unit modal mass: a'' + damping a' +
/// frequency^2 a = shape . f (N13). Bends are the sum of a times shape.
struct Modes {
  std::size_t length{0};          ///< of a shape: 2 per link
  std::vector<double> frequency;  ///< [modes] [rad/s]
  std::vector<double> damping;    ///< [modes] rate [1/s]
  std::vector<double> shape;      ///< [modes][links][2]
  int passes{0};                  ///< number of products M x that the search took

  std::size_t size() const { return frequency.size(); }
  const double* shapeOf(std::size_t mode) const { return shape.data() + mode * length; }
  std::size_t bytes() const;
};

/// Relative residual to which modes are found; at 1e-2 some modes are missed.
constexpr double MODE_TOLERANCE = 1e-4;
/// Two bending modes whose frequencies differ less than this are a pair, which is never split.
constexpr double PAIR_GAP = 0.02;

/// Finds the `count` slowest modes of K phi = w^2 M phi, one more where that would split a pair, or
/// all where there are no more. The method is block Lanczos with two vectors, so that both of two
/// equal modes are found, and with full reorthogonalisation. Each pass is O(N).
Modes slowestModes(LinearChain& chain, int count);

/// Returns the rate at which the joints' dampers slow an oscillator of this shape of unit modal
/// mass [1/s].
double modalDamping(const LinearChain& chain, const double* shape);

/// Joint torques [N m] of a load, and the number of Krylov vectors to compute from it. These begin
/// with the response to the constant load and proceed towards slow motion; `quick` is one more, of
/// fast motion (see below), or empty.
struct LoadShape {
  std::vector<double> torque;
  int depth{1};
  std::vector<double> quick{};
};

/// Returns the direction of the bends of a chain at rest after a load [2 per link] has acted for
/// `h` seconds: (M + h C + h^2 K)^-1 times the load, in one O(N) pass (N13).
std::vector<double> quickResponse(const std::vector<Link>& links, const std::vector<double>& torque,
                                  double h);

/// Adds the motion that loads cause and the modes omit: the vectors of all loads together,
/// orthogonal to the modes, as further oscillators at their Rayleigh frequencies. From depth 1 on
/// the response to a constant load is exact: the static correction, without its jump. With a quick
/// vector the response in the first moments is nearly exact too.
void addLoadVectors(LinearChain& chain, const std::vector<LoadShape>& loads, Modes& modes);

}  // namespace vegetation_sim::physics
