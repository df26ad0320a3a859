// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vegetation_sim::physics {
namespace {

struct Tridiagonal {
  std::vector<double> diagonal, beside;  // beside[i] couples i and i + 1
};

// A reflection 1 - factor v v^T; v starts at element `from`.
struct Reflection {
  std::size_t from;
  std::vector<double> v;
  double factor;
};

// Returns the reflection of row and column k of the matrix onto their elements k and k + 1.
Reflection reflectionFor(const std::vector<double>& a, std::size_t n, std::size_t k) {
  const double* row = a.data() + k * n;
  Reflection out{k + 1, std::vector<double>(row + k + 1, row + n), 0.0};
  double tail = 0.0;
  for (std::size_t i = 1; i < out.v.size(); ++i) tail += out.v[i] * out.v[i];
  if (tail == 0.0) return out;
  const double size = std::sqrt(out.v[0] * out.v[0] + tail);
  out.v[0] += out.v[0] < 0.0 ? -size : size;
  out.factor = 2.0 / (out.v[0] * out.v[0] + tail);
  return out;
}

// a := H a H for the part of the matrix that H changes.
void reflect(const Reflection& h, std::size_t n, std::vector<double>& a) {
  const std::size_t m = h.v.size();
  std::vector<double> p(m, 0.0);
  double along = 0.0;
  for (std::size_t i = 0; i < m; ++i) {
    const double* row = a.data() + (h.from + i) * n + h.from;
    for (std::size_t j = 0; j < m; ++j) p[j] += h.factor * h.v[i] * row[j];
  }
  for (std::size_t i = 0; i < m; ++i) along += h.v[i] * p[i];
  for (std::size_t i = 0; i < m; ++i) p[i] -= 0.5 * h.factor * along * h.v[i];
  for (std::size_t i = 0; i < m; ++i) {
    double* row = a.data() + (h.from + i) * n + h.from;
    for (std::size_t j = 0; j < m; ++j) row[j] -= h.v[i] * p[j] + p[i] * h.v[j];
  }
}

// Leaves the product of all reflections in `a`, transposed.
Tridiagonal tridiagonalise(std::size_t n, std::vector<double>& a) {
  Tridiagonal out{std::vector<double>(n), std::vector<double>(n, 0.0)};
  std::vector<Reflection> all;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    all.push_back(reflectionFor(a, n, k));
    const Reflection& h = all.back();
    double coupling = a[k * n + k + 1];
    for (std::size_t j = 0; h.factor > 0.0 && j < h.v.size(); ++j)
      coupling -= h.factor * h.v[0] * h.v[j] * a[k * n + k + 1 + j];
    out.beside[k] = coupling;
    if (h.factor > 0.0) reflect(h, n, a);
  }
  for (std::size_t i = 0; i < n; ++i) out.diagonal[i] = a[i * n + i];
  std::fill(a.begin(), a.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i) a[i * n + i] = 1.0;
  // a := H a from the last to the first, so row i becomes the image of unit vector i.
  for (std::size_t k = all.size(); k-- > 0;) {
    const Reflection& h = all[k];
    if (h.factor == 0.0) continue;
    for (std::size_t i = h.from; i < n; ++i) {
      double* row = a.data() + i * n + h.from;
      double along = 0.0;
      for (std::size_t j = 0; j < h.v.size(); ++j) along += row[j] * h.v[j];
      along *= h.factor;
      for (std::size_t j = 0; j < h.v.size(); ++j) row[j] -= along * h.v[j];
    }
  }
  return out;
}

// Rotates rows i and i + 1.
void turnRows(double c, double s, std::size_t n, std::size_t i, std::vector<double>& rows) {
  double *low = rows.data() + i * n, *high = low + n;
  for (std::size_t j = 0; j < n; ++j) {
    const double x = low[j], y = high[j];
    low[j] = c * x - s * y;
    high[j] = s * x + c * y;
  }
}

// Runs one implicit QL sweep over the unreduced block from l to m.
void sweepBlock(std::size_t l, std::size_t m, std::size_t n, Tridiagonal& t,
                std::vector<double>& rows) {
  std::vector<double>&d = t.diagonal, &e = t.beside;
  const double half = (d[l + 1] - d[l]) / (2.0 * e[l]);
  const double root = std::sqrt(half * half + 1.0);
  double g = d[m] - d[l] + e[l] / (half + (half < 0.0 ? -root : root));
  double s = 1.0, c = 1.0, shift = 0.0;
  for (std::size_t i = m; i-- > l;) {
    const double f = s * e[i], b = c * e[i], r = std::sqrt(f * f + g * g);
    e[i + 1] = r;
    if (r == 0.0) {  // the block splits here
      d[i + 1] -= shift;
      e[m] = 0.0;
      return;
    }
    s = f / r;
    c = g / r;
    const double next = d[i + 1] - shift, turn = (d[i] - next) * s + 2.0 * c * b;
    shift = s * turn;
    d[i + 1] = next + shift;
    g = c * turn - b;
    turnRows(c, s, n, i, rows);
  }
  d[l] -= shift;
  e[l] = g;
  e[m] = 0.0;
}

void diagonalise(std::size_t n, Tridiagonal& t, std::vector<double>& rows) {
  constexpr double EPSILON = std::numeric_limits<double>::epsilon();
  for (std::size_t l = 0; l < n; ++l) {
    for (int sweep = 0; sweep < 50; ++sweep) {  // two sweeps are usual
      std::size_t m = l;
      while (m + 1 < n && std::fabs(t.beside[m]) >
                              EPSILON * (std::fabs(t.diagonal[m]) + std::fabs(t.diagonal[m + 1])))
        ++m;
      if (m == l) break;
      sweepBlock(l, m, n, t, rows);
    }
  }
}

}  // namespace

SymmetricEigen symmetricEigen(std::vector<double> matrix, std::size_t size) {
  Tridiagonal t = tridiagonalise(size, matrix);
  std::vector<double>& rows = matrix;
  diagonalise(size, t, rows);
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return t.diagonal[a] > t.diagonal[b]; });
  SymmetricEigen out{size, {}, {}};
  for (const std::size_t i : order) {
    out.values.push_back(t.diagonal[i]);
    out.vectors.insert(out.vectors.end(), rows.begin() + static_cast<std::ptrdiff_t>(i * size),
                       rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * size));
  }
  return out;
}

}  // namespace vegetation_sim::physics
