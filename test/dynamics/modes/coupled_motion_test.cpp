// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/modes/coupled_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::physics {
namespace {

const std::vector<double> SQUARE{4.0, 25.0};
const std::vector<double> COUPLED{3.0, 2.0, 2.0, 5.0};  // [1/s]

/// Steps from an excited state for some seconds under a load that begins at 1 and 2 and rises.
ModalState after(double seconds, int steps, const std::vector<double>& damping) {
  ModalState out{{0.3, -0.2}, {1.0, 0.5}};
  const double h = seconds / steps;
  for (int i = 0; i < steps; ++i) {
    const auto load = [&](int k) { return std::vector<double>{1.0 + k * h, 2.0 - 0.5 * k * h}; };
    stepCoupled(SQUARE, damping, load(i), load(i + 1), h, out);
  }
  return out;
}

double distance(const ModalState& a, const ModalState& b) {
  double out = 0.0;
  for (std::size_t m = 0; m < a.amplitude.size(); ++m)
    out = std::max(
        {out, std::fabs(a.amplitude[m] - b.amplitude[m]), std::fabs(a.rate[m] - b.rate[m])});
  return out;
}

// Without coupling the motion is that of the exact steps.
TEST(CoupledMotion, IsThatOfSingleOscillatorsWithoutCoupling) {
  Modes modes;
  modes.frequency = {2.0, 5.0};
  modes.damping = {3.0, 5.0};
  ModalStepper exact(modes);
  ModalState right{{0.3, -0.2}, {1.0, 0.5}};
  exact.step({1.0, 2.0}, {2.0, 1.5}, 1.0, right);
  EXPECT_EQ(exact.squares(), SQUARE);
  EXPECT_LT(distance(after(1.0, 1000, {3.0, 0.0, 0.0, 5.0}), right), 1e-5);
  EXPECT_GT(distance(after(1.0, 1000, COUPLED), right), 0.01);
}

// The order of the method is two.
TEST(CoupledMotion, HasAnErrorThatFallsWithTheSquareOfTheStep) {
  const ModalState fine = after(1.0, 4096, COUPLED);
  const double coarse = distance(after(1.0, 64, COUPLED), fine);
  const double half = distance(after(1.0, 128, COUPLED), fine);
  EXPECT_NEAR(coarse / half, 4.0, 0.2);
}

// Steps far beyond the period, and damping far above the critical one, remain bounded.
TEST(CoupledMotion, IsStableForLongStepsAndStrongDamping) {
  const std::vector<double> strong{3e4, 2e4, 2e4, 5e4};
  ModalState state{{0.3, -0.2}, {1.0, 0.5}};
  for (int i = 0; i < 1000; ++i) stepCoupled(SQUARE, strong, {0.0, 0.0}, {0.0, 0.0}, 10.0, state);
  EXPECT_LT(distance(state, {{0.0, 0.0}, {0.0, 0.0}}), 1.2);
}

// M a'' = f - D a' - K a.
TEST(CoupledMotion, AccelerationsAreWhatTheForcesLeave) {
  std::vector<double> out;
  coupledAccelerations(SQUARE, COUPLED, {{0.5, 0.25}, {1.0, 2.0}}, {10.0, 20.0}, out);
  EXPECT_DOUBLE_EQ(out[0], 10.0 - (3.0 + 4.0) - 2.0);
  EXPECT_DOUBLE_EQ(out[1], 20.0 - (2.0 + 10.0) - 6.25);
}

}  // namespace
}  // namespace vegetation_sim::physics
