// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/projection_step.h"

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {

ProjectionStep::ProjectionStep(int size) : fourier_(size) {
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      const double kx = waveNumber(i, size), ky = waveNumber(j, size);
      const double square = kx * kx + ky * ky;
      turn_re_.push_back(square > 0.0 ? (kx * kx - ky * ky) / square : 0.0);
      turn_im_.push_back(square > 0.0 ? 2.0 * kx * ky / square : 0.0);
    }
  half_damping_.resize(turn_re_.size());
}

void ProjectionStep::setDecay(double decay) {
  if (decay == decay_) return;
  decay_ = decay;
  const int size = fourier_.size();
  std::vector<double> along;  // the exponential of a sum is a product
  for (int k = 0; k < size; ++k) {
    const double wave = 2.0 * PI * waveNumber(k, size);
    along.push_back(2 * k == size ? 0.0 : exponential(-decay * wave * wave));
  }
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      half_damping_[static_cast<std::size_t>(i * size + j)] =
          0.5 * along[static_cast<std::size_t>(i)] * along[static_cast<std::size_t>(j)];
}

// With Z = U + iV and K = kx + i ky: Z(k) <- (Z(k) - K^2/|K|^2 conj Z(-k)) / 2. K^2/|K|^2 is equal
// for k and -k, and a pair is computed at once.
void ProjectionStep::project(PlaneField& flow, double decay) {
  setDecay(decay);
  fourier_.forward(flow);
  const int size = fourier_.size(), mask = size - 1;
  double* re = flow.u.data();
  double* im = flow.v.data();
  for (int i = 0; i <= size / 2; ++i) {
    for (int j = 0; j < size; ++j) {
      const int here = i * size + j, there = ((size - i) & mask) * size + ((size - j) & mask);
      if (there <= here) continue;
      const auto k = static_cast<std::size_t>(here);
      const double c = turn_re_[k], s = turn_im_[k], half = half_damping_[k];
      const double a_re = re[here], a_im = im[here], b_re = re[there], b_im = im[there];
      re[here] = half * (a_re - (c * b_re + s * b_im));
      im[here] = half * (a_im - (s * b_re - c * b_im));
      re[there] = half * (b_re - (c * a_re + s * a_im));
      im[there] = half * (b_im - (s * a_re - c * a_im));
    }
  }
  for (const int i : {0, size / 2})
    for (const int j : {0, size / 2})
      if (i + j > 0) re[i * size + j] = im[i * size + j] = 0.0;
  fourier_.inverse(flow);
}

}  // namespace vegetation_sim::canopy
