// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace vegetation_sim::canopy {

/// Sizes of a field are powers of two because of the Fourier transform.
constexpr int SMALLEST_FIELD = 16, LARGEST_FIELD = 256;
inline bool isFieldSize(int size) {
  return size >= SMALLEST_FIELD && size <= LARGEST_FIELD && (size & (size - 1)) == 0;
}

/// Vectors on a periodic square of size x size cells: component u to the right and v upwards, row
/// after row from the lowest; cell (x, y) has index y * size + x. FourierPlane transforms it as
/// complex numbers u + iv.
struct PlaneField {
  PlaneField() = default;
  explicit PlaneField(int cells) : size(cells), u(area(), 0.0), v(area(), 0.0) {}

  std::size_t area() const {
    return static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
  }

  int size{0};
  std::vector<double> u, v;
};

struct PlaneVector {
  double u{0.0}, v{0.0};
};

/// Returns the mean of (u^2 + v^2) / 2 over the cells; not finite if one cell is not.
inline double energyOf(const PlaneField& field) {
  double sum = 0.0;
  for (std::size_t i = 0; i < field.u.size(); ++i)
    sum += field.u[i] * field.u[i] + field.v[i] * field.v[i];
  return field.u.empty() ? 0.0 : 0.5 * sum / static_cast<double>(field.u.size());
}

/// Returns the bilinear value at (x, y), in cells, of the periodic field. |x|, |y| < 2^30.
inline PlaneVector bilinear(const PlaneField& field, double x, double y) {
  const double left = std::floor(x), low = std::floor(y);
  const double p = x - left, q = y - low;
  const int mask = field.size - 1;
  const int x0 = static_cast<int>(left) & mask, y0 = static_cast<int>(low) & mask;
  const int x1 = (x0 + 1) & mask, y1 = (y0 + 1) & mask;
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row * field.size + column);
  };
  const std::size_t a = at(x0, y0), b = at(x1, y0), c = at(x0, y1), d = at(x1, y1);
  const double wa = (1.0 - p) * (1.0 - q), wb = p * (1.0 - q), wc = (1.0 - p) * q, wd = p * q;
  return {(wa * field.u[a] + wb * field.u[b]) + (wc * field.u[c] + wd * field.u[d]),
          (wa * field.v[a] + wb * field.v[b]) + (wc * field.v[c] + wd * field.v[d])};
}

}  // namespace vegetation_sim::canopy
