// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/modes/modes.h"

#include <algorithm>
#include <cmath>

#include "dynamics/modes/krylov.h"

namespace vegetation_sim::physics {
namespace {

// least number of vectors between two checks of convergence
constexpr std::size_t CHECK_EVERY = 8;

// Returns how many of `values` (1 / w^2, falling) are the first `count` without splitting a pair.
std::size_t uncut(const std::vector<double>& values, std::size_t count) {
  std::size_t i = 0;
  while (i < count && i < values.size()) {
    const bool pair =
        i + 1 < values.size() && std::sqrt(values[i] / values[i + 1]) < 1.0 + PAIR_GAP;
    i += pair ? 2 : 1;
  }
  return i;
}

bool converged(const Krylov& krylov, const SymmetricEigen& ritz, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!(krylov.residual(ritz, i) <= MODE_TOLERANCE)) return false;
  return true;
}

}  // namespace

std::size_t Modes::bytes() const {
  return sizeof(double) * (frequency.size() + damping.size() + shape.size());
}

double modalDamping(const LinearChain& chain, const double* shape) {
  double sum = 0.0;
  for (std::size_t k = 0; k < chain.size(); ++k) sum += chain.damping()[k] * (shape[k] * shape[k]);
  return sum;
}

Modes slowestModes(LinearChain& chain, int count) {
  Modes out;
  out.length = chain.size();
  const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(0, count)), out.length);
  if (wanted == 0) return out;
  Krylov krylov(chain);
  SymmetricEigen ritz;
  // A check costs the cube of the number of vectors, so they are few where modes are many.
  const std::size_t more = std::max(CHECK_EVERY, wanted / 2);
  std::size_t taken = 0, size = 2 * wanted + CHECK_EVERY;
  do {
    size += more;
    while (krylov.size() < size && !krylov.full()) krylov.grow();
    ritz = krylov.ritz();
    taken = uncut(ritz.values, wanted);
  } while (!krylov.full() && !converged(krylov, ritz, taken));
  krylov.shapes(ritz, taken, out.shape);
  for (std::size_t i = 0; i < taken; ++i) {
    out.frequency.push_back(1.0 / std::sqrt(ritz.values[i]));
    out.damping.push_back(modalDamping(chain, out.shapeOf(i)));
  }
  out.passes = krylov.passes();
  return out;
}

}  // namespace vegetation_sim::physics
