// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace vegetation_sim::physics {

/// Eigenvalues, falling, and unit eigenvectors of a small symmetric matrix.
struct SymmetricEigen {
  std::size_t size{0};
  std::vector<double> values;   ///< [size]
  std::vector<double> vectors;  ///< [size][size], one per row
  const double* vector(std::size_t i) const { return vectors.data() + i * size; }
};

/// Solves with Householder's reflections to a tridiagonal matrix, then QL with implicit shifts. The
/// same bits on every processor.
/// @param matrix [size][size]
SymmetricEigen symmetricEigen(std::vector<double> matrix, std::size_t size);

}  // namespace vegetation_sim::physics
