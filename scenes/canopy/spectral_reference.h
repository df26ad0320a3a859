// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <vector>

#include "vegetation_sim/canopy/plane/fourier_plane.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {

/// Euler's equations on a periodic square of 1 m by a dealiased spectral method and the
/// fourth-order Runge-Kutta method: slow, but its error is far below those it is compared with.
class SpectralReference {
 public:
  explicit SpectralReference(const PlaneField& flow)
      : size_(flow.size), fourier_(flow.size), modes_(flow.area()) {
    PlaneField spectrum = flow;
    fourier_.forward(spectrum);
    for (std::size_t i = 0; i < modes_.size(); ++i) modes_[i] = {spectrum.u[i], spectrum.v[i]};
  }

  void step(double dt) {
    const Modes start = modes_;
    const Modes k1 = rate(start), k2 = rate(along(start, k1, 0.5 * dt)),
                k3 = rate(along(start, k2, 0.5 * dt)), k4 = rate(along(start, k3, dt));
    for (std::size_t i = 0; i < start.size(); ++i)
      modes_[i] = start[i] + dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }

  /// Returns the flow at every `stride`-th cell.
  PlaneField flow(int stride = 1) {
    const PlaneField fine = toCells(modes_);
    PlaneField out(size_ / stride);
    for (int y = 0; y < out.size; ++y)
      for (int x = 0; x < out.size; ++x) {
        const auto to = static_cast<std::size_t>(y * out.size + x);
        const auto from = static_cast<std::size_t>((y * size_ + x) * stride);
        out.u[to] = fine.u[from];
        out.v[to] = fine.v[from];
      }
    return out;
  }

 private:
  using Complex = std::complex<double>;
  using Modes = std::vector<Complex>;  // of u + iv

  static Modes along(const Modes& start, const Modes& rate, double dt) {
    Modes out(start.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = start[i] + dt * rate[i];
    return out;
  }

  std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * size_ + j); }
  // Return the modes of the real fields u and v from those of u + iv.
  Complex modeU(const Modes& z, int i, int j) const {
    return 0.5 * (z[index(i, j)] + std::conj(opposite(z, i, j)));
  }
  Complex modeV(const Modes& z, int i, int j) const {
    return Complex(0.0, -0.5) * (z[index(i, j)] - std::conj(opposite(z, i, j)));
  }
  Complex opposite(const Modes& z, int i, int j) const {
    return z[index((size_ - i) % size_, (size_ - j) % size_)];
  }

  PlaneField toCells(const Modes& modes) {
    PlaneField out(size_);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      out.u[i] = modes[i].real();
      out.v[i] = modes[i].imag();
    }
    fourier_.inverse(out);
    return out;
  }

  // Returns (v w, -u w) with the vorticity w, without its divergence and the upper third of the
  // modes.
  Modes rate(const Modes& z) {
    Modes vorticity(z.size());
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j)
        vorticity[index(i, j)] =
            Complex(0.0, 2.0 * PI) * (1.0 * waveNumber(i, size_) * modeV(z, i, j) -
                                      1.0 * waveNumber(j, size_) * modeU(z, i, j));
    const PlaneField w = toCells(vorticity);
    PlaneField product = toCells(z);
    for (std::size_t i = 0; i < w.u.size(); ++i) {
      const double u = product.u[i];
      product.u[i] = product.v[i] * w.u[i];
      product.v[i] = -u * w.u[i];
    }
    fourier_.forward(product);
    Modes raw(z.size()), out(z.size());
    for (std::size_t i = 0; i < raw.size(); ++i) raw[i] = {product.u[i], product.v[i]};
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j) {
        const double kx = waveNumber(i, size_), ky = waveNumber(j, size_);
        if (3.0 * std::abs(kx) >= size_ || 3.0 * std::abs(ky) >= size_ || kx * kx + ky * ky < 0.5)
          continue;
        const Complex u = modeU(raw, i, j), v = modeV(raw, i, j);
        const Complex along = (kx * u + ky * v) / (kx * kx + ky * ky);
        out[index(i, j)] = (u - kx * along) + Complex(0.0, 1.0) * (v - ky * along);
      }
    return out;
  }

  int size_;
  FourierPlane fourier_;
  Modes modes_;
};

/// Returns the norm of the divergence over the norm of the modes times their wave numbers. The
/// highest wave number has no sign and is left out.
inline double relativeDivergence(const PlaneField& flow) {
  PlaneField z = flow;
  FourierPlane(flow.size).forward(z);
  const int size = flow.size;
  double divergence = 0.0, all = 0.0;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      if (2 * i == size || 2 * j == size) continue;
      const auto here = static_cast<std::size_t>(i * size + j);
      const auto there = static_cast<std::size_t>((size - i) % size * size + (size - j) % size);
      const std::complex<double> a(z.u[here], z.v[here]), b(z.u[there], -z.v[there]);
      const std::complex<double> u = 0.5 * (a + b), v = std::complex<double>(0.0, -0.5) * (a - b);
      const double kx = waveNumber(i, size), ky = waveNumber(j, size);
      divergence += std::norm(kx * u + ky * v);
      all += (kx * kx + ky * ky) * (std::norm(u) + std::norm(v));
    }
  return std::sqrt(divergence / all);
}

}  // namespace vegetation_sim::canopy
