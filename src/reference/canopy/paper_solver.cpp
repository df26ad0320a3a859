// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/reference/canopy/paper_solver.h"

#include <algorithm>

#include "vegetation_sim/canopy/plane/advection.h"

namespace vegetation_sim::canopy {

PaperSolver::PaperSolver(int size, int sweeps, bool warm)
    : size_(size), sweeps_(sweeps), warm_(warm), scratch_(size) {
  divergence_.resize(scratch_.area());
  pressure_.resize(scratch_.area());
}

void PaperSolver::reset() {
  std::fill(pressure_.begin(), pressure_.end(), 0.0);
}

// Solves (1 + 4 weight) x - weight * (sum of the four neighbours) = right by sweeps. A weight of 0
// stands for infinity: 4 x - sum = right.
void PaperSolver::relax(std::vector<double>& x, const std::vector<double>& right,
                        double weight) const {
  const double share = weight > 0.0 ? weight : 1.0;
  const double inverse = 1.0 / (weight > 0.0 ? 1.0 + 4.0 * weight : 4.0);
  const int mask = size_ - 1;
  for (int sweep = 0; sweep < sweeps_; ++sweep)
    for (int row = 0; row < size_; ++row) {
      double* here = x.data() + row * size_;
      const double* below = x.data() + ((row - 1) & mask) * size_;
      const double* above = x.data() + ((row + 1) & mask) * size_;
      const double* wanted = right.data() + row * size_;
      for (int i = 0; i < size_; ++i)
        here[i] = inverse * (wanted[i] + share * ((here[(i - 1) & mask] + here[(i + 1) & mask]) +
                                                  (below[i] + above[i])));
    }
}

void PaperSolver::project(PlaneField& flow) {
  const int mask = size_ - 1;
  const auto each = [&](auto&& body) {
    for (int row = 0; row < size_; ++row)
      for (int i = 0; i < size_; ++i)
        body(row * size_ + i, row * size_ + ((i - 1) & mask), row * size_ + ((i + 1) & mask),
             ((row - 1) & mask) * size_ + i, ((row + 1) & mask) * size_ + i);
  };
  const double* u = flow.u.data();
  const double* v = flow.v.data();
  each([&](int here, int left, int right, int below, int above) {
    divergence_[static_cast<std::size_t>(here)] =
        -0.5 * ((u[right] - u[left]) + (v[above] - v[below]));
  });
  if (!warm_) reset();
  relax(pressure_, divergence_, 0.0);
  const double* p = pressure_.data();
  each([&](int here, int left, int right, int below, int above) {
    flow.u[static_cast<std::size_t>(here)] -= 0.5 * (p[right] - p[left]);
    flow.v[static_cast<std::size_t>(here)] -= 0.5 * (p[above] - p[below]);
  });
}

void PaperSolver::step(PlaneField& flow, double decay, double cells) {
  advect(flow, flow, cells, Lookup::BILINEAR, scratch_);
  std::swap(flow, scratch_);
  const double weight = decay * size_ * size_;
  if (weight > 0.0) {
    scratch_ = flow;
    relax(flow.u, scratch_.u, weight);
    relax(flow.v, scratch_.v, weight);
  }
  project(flow);
}

}  // namespace vegetation_sim::canopy
