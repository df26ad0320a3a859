// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/symmetric_eigen.h"
#include "vegetation_sim/dynamics/chain/linear_chain.h"

namespace vegetation_sim::physics {

/// Block Lanczos, two vectors at a time and all kept orthogonal, on K^-1/2 M K^-1/2 of a chain. Its
/// largest eigenvalues 1 / w^2 belong to the slowest modes. A single vector would find only one of
/// two equal modes. The length of its vectors is even, so blocks are whole.
class Krylov {
 public:
  explicit Krylov(LinearChain& chain);

  /// Adds two more vectors, as long as there are any.
  void grow();
  std::size_t size() const { return done_; }
  bool full() const { return done_ == length_; }
  int passes() const { return passes_; }

  /// Returns Ritz values, falling, and vectors in terms of the basis.
  SymmetricEigen ritz() const;
  /// Returns the relative residual of Ritz vector i: the part of its image that lies outside the
  /// space.
  double residual(const SymmetricEigen& ritz, std::size_t i) const;
  /// Returns the first Ritz vectors as bends of unit modal mass: [count][length].
  void shapes(const SymmetricEigen& ritz, std::size_t count, std::vector<double>& out) const;

 private:
  static constexpr std::size_t BLOCK = 2, BAND = 2 * BLOCK;
  double* vector(std::size_t i) { return basis_.data() + i * length_; }
  const double* vector(std::size_t i) const { return basis_.data() + i * length_; }
  void apply(const double* x, double* out);
  void randomVector(double* out);
  void fillRandom(std::size_t i);
  double normalise(std::size_t i);
  void addImage(std::size_t i, double least);

  LinearChain& chain_;
  // number of vectors whose image is known; number of vectors
  std::size_t length_, done_{0}, known_{0};
  std::vector<double> root_, scaled_;  // K^-1/2; scratch
  std::vector<double> basis_;          // [known][length]
  std::vector<double> band_;           // [done][BAND] products of image and vectors before it
  double beyond_[BLOCK][BLOCK];        // [image][new vector] of the last block
  std::uint64_t seed_{0};
  int passes_{0};
};

}  // namespace vegetation_sim::physics
