// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/plane/advection.h"

#include <algorithm>
#include <array>

namespace vegetation_sim::canopy {
namespace {

struct Weights {
  std::array<double, 4> of;
};

// Returns the weights of Catmull and Rom's spline at p in [0, 1) between the second and the third
// of four points.
Weights cubicWeights(double p) {
  const double p2 = p * p, p3 = p2 * p;
  return {{-0.5 * p3 + p2 - 0.5 * p, 1.5 * p3 - 2.5 * p2 + 1.0, -1.5 * p3 + 2.0 * p2 + 0.5 * p,
           0.5 * p3 - 0.5 * p2}};
}

PlaneVector cubic(const PlaneField& field, double x, double y) {
  const double left = std::floor(x), low = std::floor(y);
  const Weights wx = cubicWeights(x - left), wy = cubicWeights(y - low);
  const int mask = field.size - 1;
  const int x1 = static_cast<int>(left), y1 = static_cast<int>(low);
  const int c0 = (x1 - 1) & mask, c1 = x1 & mask, c2 = (x1 + 1) & mask, c3 = (x1 + 2) & mask;
  PlaneVector out;
  for (int j = 0; j < 4; ++j) {
    const int row = ((y1 - 1 + j) & mask) * field.size;
    const double* u = field.u.data() + row;
    const double* v = field.v.data() + row;
    const double w = wy.of[static_cast<std::size_t>(j)];
    out.u += w * ((wx.of[0] * u[c0] + wx.of[1] * u[c1]) + (wx.of[2] * u[c2] + wx.of[3] * u[c3]));
    out.v += w * ((wx.of[0] * v[c0] + wx.of[1] * v[c1]) + (wx.of[2] * v[c2] + wx.of[3] * v[c3]));
  }
  return out;
}

// The clamp also keeps the conversion to int within its range.
double wayBack(double speed, double cells, double limit) {
  return std::min(limit, std::max(-limit, speed * cells));
}

}  // namespace

void advect(const PlaneField& field, const PlaneField& velocity, double cells, Lookup lookup,
            PlaneField& out) {
  const double limit = field.size;
  for (int row = 0; row < field.size; ++row) {
    for (int column = 0; column < field.size; ++column) {
      const auto i = static_cast<std::size_t>(row * field.size + column);
      PlaneVector here{velocity.u[i], velocity.v[i]};
      if (lookup == Lookup::CUBIC)
        here = bilinear(velocity, column - 0.5 * wayBack(here.u, cells, limit),
                        row - 0.5 * wayBack(here.v, cells, limit));
      const double x = column - wayBack(here.u, cells, limit);
      const double y = row - wayBack(here.v, cells, limit);
      const PlaneVector value =
          lookup == Lookup::CUBIC ? cubic(field, x, y) : bilinear(field, x, y);
      out.u[i] = value.u;
      out.v[i] = value.v;
    }
  }
}

}  // namespace vegetation_sim::canopy
