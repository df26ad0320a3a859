// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "tree/modal/modal_load.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/modal/modal_tree.h"

namespace vegetation_sim::forest {

std::vector<Vec3> ModalTree::velocitiesOf(const ModalAir& air) const {
  std::vector<Vec3> out(coarse_.at.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = air.sampler.velocity(i);
  return out;
}

namespace {

// With v the wind, u the velocity of the wood and r = v - u, the drag of the wind on wood at rest
// minus that of the relative velocity is |v| v - |r| r = D u, with
// D = |r| I + v (v + r)^T / (|v| + |r|), which is taken to be symmetric.
std::array<Vec3, 3> secantOf(const Vec3& v, const Vec3& r) {
  const double speed = length(r), sum = length(v) + speed;
  std::array<Vec3, 3> out{};
  if (!(sum > 0.0)) return out;
  const Vec3 both = v + r;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      out[static_cast<std::size_t>(i)][k] =
          (i == k ? speed : 0.0) + 0.5 * (v[i] * both[k] + both[i] * v[k]) / sum;
  return out;
}

}  // namespace

// Modes m and n that move a point by w_m and w_n per amplitude are coupled by w_m . D w_n there.
void ModalTree::dampingIn(const std::vector<Vec3>& velocity, const std::vector<double>& rate,
                          std::vector<double>& out) const {
  const std::size_t count = size(), row = modalRow(count);
  out.assign(count * count, 0.0);
  for (std::size_t m = 0; m < count; ++m) out[m * count + m] = joints_[m];
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double drag = coarse_.at[i].drag;
    const double* x = coarse_.push.data() + 3 * row * i;  // drag times the way of each mode
    const double *y = x + row, *z = y + row;
    Vec3 own = Vec3::Zero();
    for (std::size_t m = 0; m < count; ++m) own += rate[m] * Vec3(x[m], y[m], z[m]);
    const auto secant = secantOf(velocity[i], velocity[i] - own / drag);
    for (std::size_t n = 0; n < count; ++n) {
      const Vec3 way = Vec3(x[n], y[n], z[n]) / (drag * reference_speed_);
      const Vec3 force(dot(secant[0], way), dot(secant[1], way), dot(secant[2], way));
      for (std::size_t m = 0; m < count; ++m)
        out[n * count + m] += force.x() * x[m] + force.y() * y[m] + force.z() * z[m];
    }
  }
}

Vec3 ModalTree::leverAir(const Vec3& air, const std::vector<double>& rate) const {
  if (drag_ == Drag::LINEAR) return air;
  const std::size_t row = modalRow(size());
  double drag = 0.0;
  for (const WindPoint& point : coarse_.at) drag += point.drag;
  Vec3 relative = air;
  for (std::size_t m = 0; drag > 0.0 && m < size(); ++m)
    relative -= rate[m] / drag * Vec3(uniform_[m], uniform_[row + m], uniform_[2 * row + m]);
  return effectiveVelocity(relative, drag_, reference_speed_);
}

}  // namespace vegetation_sim::forest
