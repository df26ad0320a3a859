// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/canopy/plane/plane_field.h"

namespace vegetation_sim::canopy {

/// Discrete Fourier transform of a PlaneField taken as complex numbers u + iv. It is our own
/// because its results are state: it has the same bits on every processor and instruction set, with
/// twiddles of core/math and without fused operations (docs/canopy.md compares it with kissfft).
/// Holds scratch memory: one thread at a time.
class FourierPlane {
 public:
  /// @throws std::invalid_argument unless isFieldSize(size).
  explicit FourierPlane(int size);

  int size() const { return size_; }
  /// Transforms in place. Mode (kx, ky), counted 0 to size - 1, goes to index kx * size + ky, which
  /// is transposed.
  void forward(PlaneField& field) { transform(field.u, field.v); }
  /// Transforms back in place from that order, scaled so that it inverts forward().
  void inverse(PlaneField& field);

 private:
  void transform(std::vector<double>& re, std::vector<double>& im);

  int size_;
  std::vector<double> cosine_, sine_;  // cosine and sine of -k turns / size
  std::vector<double> re_, im_, lanes_;
};

/// Returns the signed wave number of mode index k.
inline int waveNumber(int k, int size) {
  return k <= size / 2 ? k : k - size;
}

}  // namespace vegetation_sim::canopy
