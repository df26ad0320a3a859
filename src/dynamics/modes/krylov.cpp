// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/modes/krylov.h"

#include <algorithm>
#include <cmath>

#include "core/math/vector_sums.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::physics {
namespace {

constexpr int FILTERED = 3;           // passes that remove fast modes from a random vector
constexpr std::size_t EXPECTED = 80;  // vectors, for 20 modes
constexpr double DEPENDENT = 1e-10;   // remainder of a vector that adds nothing

}  // namespace

Krylov::Krylov(LinearChain& chain) : chain_(chain), length_(chain.size()), scaled_(length_) {
  for (const double k : chain.stiffness()) root_.push_back(1.0 / std::sqrt(k));
  basis_.reserve(std::min<std::size_t>(length_, EXPECTED) * length_);
  basis_.resize(BLOCK * length_);
  for (; known_ < BLOCK; ++known_) fillRandom(known_);
}

void Krylov::apply(const double* x, double* out) {
  for (std::size_t k = 0; k < length_; ++k) scaled_[k] = root_[k] * x[k];
  chain_.timesMass(scaled_.data(), out);
  for (std::size_t k = 0; k < length_; ++k) out[k] *= root_[k];
  ++passes_;
}

void Krylov::randomVector(double* out) {
  const Random random(seed_++);
  std::vector<double> x(length_);
  for (std::size_t k = 0; k < length_; ++k) x[k] = random.uniform(k, -1.0, 1.0);
  for (int pass = 0; pass < FILTERED; ++pass) {
    apply(x.data(), out);
    x.assign(out, out + length_);
  }
}

double Krylov::normalise(std::size_t i) {
  double* x = vector(i);
  const double size = std::sqrt(dotOf(x, x, length_));
  for (std::size_t k = 0; k < length_; ++k) x[k] /= size;
  return size;
}

void Krylov::fillRandom(std::size_t i) {
  randomVector(vector(i));
  for (int round = 0; round < 2; ++round) {  // two rounds are enough
    normalise(i);
    for (std::size_t j = 0; j < i; ++j)
      addScaled(-dotOf(vector(j), vector(i), length_), vector(j), length_, vector(i));
  }
  normalise(i);
}

void Krylov::grow() {
  basis_.resize((known_ + BLOCK) * length_);
  double sizes[BLOCK];
  for (std::size_t i = 0; i < BLOCK; ++i) {
    double* image = vector(known_ + i);
    apply(vector(done_ + i), image);
    sizes[i] = std::sqrt(dotOf(image, image, length_));
    for (std::size_t b = 0; b < BAND; ++b)
      band_.push_back(b <= done_ + i ? dotOf(vector(done_ + i - b), image, length_) : 0.0);
  }
  done_ = known_;
  std::fill(&beyond_[0][0], &beyond_[0][0] + BLOCK * BLOCK, 0.0);
  if (full()) return;
  // Most of what images share with the basis lies in the last two blocks; little remains to be
  // removed after those.
  const std::size_t recent = done_ < BAND ? 0 : done_ - BAND;
  for (const std::size_t from : {recent, std::size_t{0}})
    for (std::size_t j = from; j < done_; ++j)
      makeOrthogonal(vector(j), length_, vector(done_), vector(done_ + 1));
  for (std::size_t i = 0; i < BLOCK; ++i) addImage(i, DEPENDENT * sizes[i]);
}

// The image of vector i of the last block becomes a new vector, unless nothing remains of it: a
// Krylov space of a symmetric tree may end early, and another starts.
void Krylov::addImage(std::size_t i, double least) {
  double* x = vector(known_);
  for (std::size_t j = 0; j < i; ++j) {
    beyond_[i][j] = dotOf(vector(done_ + j), x, length_);
    addScaled(-beyond_[i][j], vector(done_ + j), length_, x);
  }
  beyond_[i][i] = normalise(known_);
  if (!(beyond_[i][i] > least)) {
    beyond_[i][i] = 0.0;
    fillRandom(known_);
  }
  ++known_;
}

SymmetricEigen Krylov::ritz() const {
  std::vector<double> t(done_ * done_, 0.0);
  for (std::size_t i = 0; i < done_; ++i)
    for (std::size_t b = 0; b < BAND && b <= i; ++b)
      t[i * done_ + i - b] = t[(i - b) * done_ + i] = band_[i * BAND + b];
  return symmetricEigen(std::move(t), done_);
}

double Krylov::residual(const SymmetricEigen& ritz, std::size_t i) const {
  double square = 0.0;
  for (std::size_t fresh = 0; fresh < known_ - done_; ++fresh) {
    double part = 0.0;
    for (std::size_t image = 0; image < BLOCK; ++image)
      part += beyond_[image][fresh] * ritz.vector(i)[done_ - BLOCK + image];
    square += part * part;
  }
  return std::sqrt(square) / ritz.values[i];
}

void Krylov::shapes(const SymmetricEigen& ritz, std::size_t count, std::vector<double>& out) const {
  // part of a vector that stays in the cache for all of its readers
  constexpr std::size_t PART = 256;
  out.assign(count * length_, 0.0);
  for (std::size_t k = 0; k < length_; k += PART) {
    const std::size_t n = std::min(PART, length_ - k);
    for (std::size_t i = 0; i < count; ++i) {
      double* to = out.data() + i * length_ + k;
      const double scale = 1.0 / std::sqrt(ritz.values[i]);
      for (std::size_t j = 0; j < done_; ++j) addScaled(ritz.vector(i)[j], vector(j) + k, n, to);
      for (std::size_t b = 0; b < n; ++b) to[b] *= scale * root_[k + b];
    }
  }
}

}  // namespace vegetation_sim::physics
