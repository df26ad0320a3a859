// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/modes/coupled_motion.h"

namespace vegetation_sim::physics {
namespace {

// Solves a positive definite system [n][n] by elimination, for which no pivots are needed. The
// order of all operations is fixed, so that the bits are the same on every processor.
void solve(std::vector<double>& matrix, std::vector<double>& right) {
  const std::size_t n = right.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = matrix[i * n + k] / matrix[k * n + k];
      for (std::size_t j = k + 1; j < n; ++j) matrix[i * n + j] -= factor * matrix[k * n + j];
      right[i] -= factor * right[k];
    }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) right[k] -= matrix[k * n + j] * right[j];
    right[k] /= matrix[k * n + k];
  }
}

}  // namespace

// With a = a0 + h/2 v and f the mean load, (1 + h/2 D + h^2/4 w^2) v = v0 + h/2 (f - w^2 a0) gives
// the rate v in the middle of the step.
void stepCoupled(const std::vector<double>& square, const std::vector<double>& damping,
                 const std::vector<double>& before, const std::vector<double>& after, double h,
                 ModalState& state) {
  const std::size_t n = square.size();
  std::vector<double> matrix(n * n), middle(n);
  for (std::size_t k = 0; k < n * n; ++k) matrix[k] = 0.5 * h * damping[k];
  for (std::size_t m = 0; m < n; ++m) {
    matrix[m * n + m] += 1.0 + 0.25 * h * h * square[m];
    middle[m] =
        state.rate[m] + 0.5 * h * (0.5 * (before[m] + after[m]) - square[m] * state.amplitude[m]);
  }
  solve(matrix, middle);
  for (std::size_t m = 0; m < n; ++m) {
    state.amplitude[m] += h * middle[m];
    state.rate[m] = 2.0 * middle[m] - state.rate[m];
  }
}

void coupledAccelerations(const std::vector<double>& square, const std::vector<double>& damping,
                          const ModalState& state, const std::vector<double>& load,
                          std::vector<double>& out) {
  const std::size_t n = square.size();
  out.resize(n);
  for (std::size_t m = 0; m < n; ++m) {
    double drag = 0.0;
    for (std::size_t k = 0; k < n; ++k) drag += damping[m * n + k] * state.rate[k];
    out[m] = load[m] - drag - square[m] * state.amplitude[m];
  }
}

}  // namespace vegetation_sim::physics
