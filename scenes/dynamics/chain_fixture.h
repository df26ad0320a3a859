// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "dynamics/chain/inertia_bound.h"
#include "dynamics/integration/integrator.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::physics {

/// A round bar that turns about its end.
inline Link bar(int parent, double h, double length, double radius, double modulus,
                double density) {
  Link out;
  out.parent = parent;
  out.h = h;
  out.length = length;
  out.mass = density * M_PI * radius * radius * length;
  out.centre = Vec3(0.0, 0.0, 0.5 * length);
  const double across = out.mass * (length * length / 3.0 + radius * radius / 4.0);
  out.inertia = {across, across, 0.5 * out.mass * radius * radius, 0.0, 0.0, 0.0};
  out.stiffness = modulus * M_PI * std::pow(radius, 4) / (4.0 * length);
  return out;
}

/// A straight upright beam of `n` equal pieces. Every joint but the root's represents a whole
/// piece, the root's half of one, so that the chain is second order in 1/n.
inline std::vector<Link> beam(int n, double length, double radius, double modulus, double density) {
  std::vector<Link> out;
  for (int i = 0; i < n; ++i) {
    out.push_back(bar(i - 1, i ? length / n : 0.0, length / n, radius, modulus, density));
    if (i == 0) out[0].stiffness *= 2.0;
  }
  shareInertia(out);
  return out;
}

/// A crown: forks down to 2 mm twigs, length ~ radius^(2/3), wood of 8 GPa and 900 kg/m^3, and
/// dampers of `ratio` on the inertia of each link's straightened sub-tree.
inline std::vector<Link> crown(std::size_t count, double ratio, std::uint64_t seed = 1) {
  const Random random(seed);
  std::vector<Link> out;
  std::vector<double> radius;
  for (std::size_t i = 0; i < count; ++i) {
    const int parent = static_cast<int>(i) - 1 < 0 ? -1 : static_cast<int>((i - 1) / 2);
    const double r = parent < 0 ? 0.03 : std::max(0.002, 0.72 * radius[(i - 1) / 2]);
    const double l = 0.9 * std::pow(r / 0.03, 2.0 / 3.0);
    const double h = parent < 0 ? 0.0 : out[(i - 1) / 2].length * (i % 2 ? 1.0 : 0.7);
    Link link = bar(parent, h, l, r, 8e9, 900.0);
    const double turn = random.uniform(2 * i, -3.0, 3.0),
                 lean = random.uniform(2 * i + 1, 0.2, 0.8);
    link.rest = Quat{std::cos(turn / 2), 0.0, 0.0, std::sin(turn / 2)} *
                Quat{std::cos(lean / 2), 0.0, std::sin(lean / 2), 0.0};
    out.push_back(link);
    radius.push_back(r);
  }
  std::vector<double> mass(count), first(count), second(count);
  for (std::size_t i = count; i-- > 0;) {
    mass[i] += out[i].mass;
    first[i] += out[i].mass * out[i].centre.z();
    second[i] += out[i].inertia.xx;
    out[i].damping = 2.0 * ratio * std::sqrt(out[i].stiffness * second[i]);
    if (i == 0) break;
    const std::size_t p = (i - 1) / 2;
    mass[p] += mass[i];
    first[p] += first[i] + mass[i] * out[i].h;
    second[p] += second[i] + 2.0 * out[i].h * first[i] + mass[i] * out[i].h * out[i].h;
  }
  shareInertia(out);
  return out;
}

inline ChainState atRest(std::size_t n) {
  return {std::vector<Vec2>(n, Vec2::Zero()), std::vector<Vec2>(n, Vec2::Zero())};
}

inline ChainState randomState(std::size_t n, double angle, double rate, std::uint64_t seed) {
  const Random random(seed);
  ChainState out;
  for (std::uint64_t i = 0; i < n; ++i) {
    out.q.emplace_back(random.uniform(4 * i, -angle, angle),
                       random.uniform(4 * i + 1, -angle, angle));
    out.rate.emplace_back(random.uniform(4 * i + 2, -rate, rate),
                          random.uniform(4 * i + 3, -rate, rate));
  }
  return out;
}

inline Kinematics kinematicsAt(const std::vector<Link>& links, const ChainState& state,
                               const std::vector<BaseMotion>& bases = {}) {
  Kinematics out;
  kinematicsOf(links, bases, state, out);
  return out;
}

/// A smooth push on every link for one second [N per m of link].
inline Surroundings gust(const std::vector<Link>& links, double strength) {
  Surroundings out;
  out.loads = [&links, strength](const Kinematics&, double t, Loads& loads) {
    const double s = t < 1.0 ? std::sin(M_PI * t) : 0.0;
    for (std::size_t i = 0; i < links.size(); ++i)
      loads.wrench[i].force = strength * s * s * links[i].length * Vec3(1.0, 0.3, 0.0);
  };
  return out;
}

/// Chain, state and guard that step together.
struct Simulation {
  std::vector<Link> links;
  Integrator integrator{Integrator::MIDPOINT};
  ChainState state{atRest(links.size())};
  double theta{0.5};
  ChainStepper stepper{};

  void step(const Surroundings& outside, double time, double h) {
    stepper.stepAsIs(integrator, links, outside, time, h, state, theta);
  }
  std::vector<Vec3> tips() const {
    const Kinematics k = kinematicsAt(links, state);
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < links.size(); ++i)
      out.push_back(k.pose[i].position + links[i].length * axisZ(k.pose[i].orientation));
    return out;
  }
};

inline double rms(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace vegetation_sim::physics
