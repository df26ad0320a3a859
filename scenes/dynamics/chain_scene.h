// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstring>

#include "scenes/dynamics/chain_fixture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::physics {

/// Step of a chain in tests and benches [s].
constexpr double STEP = 1.0 / 240.0;

/// Sets a tenth of the critical damping, on the inertia of all that a joint carries if it hung
/// straight. This is rough, but scales correctly.
inline void damp(std::vector<Link>& links) {
  std::vector<double> mass(links.size()), moment(links.size()), second(links.size());
  for (std::size_t i = links.size(); i-- > 0;) {
    const double h = links[i].h;
    mass[i] += links[i].mass;
    moment[i] += links[i].mass * links[i].centre.z();
    second[i] += links[i].inertia.xx;
    links[i].damping = 0.2 * std::sqrt(links[i].stiffness * second[i]);
    if (links[i].parent < 0) continue;
    const auto p = static_cast<std::size_t>(links[i].parent);
    mass[p] += mass[i];
    moment[p] += moment[i] + mass[i] * h;
    second[p] += second[i] + 2.0 * h * moment[i] + mass[i] * h * h;
  }
}

/// The family of fractal trees: `n` links, trunk radius 9 cm, tips 2 mm, length ~ r^(2/3), about 8
/// m high.
inline std::vector<Link> fractalTree(int n, std::uint64_t seed) {
  struct Share {
    int parent, links;
    double azimuth;
  };
  const Random random(seed);
  std::vector<Link> out;
  std::vector<Share> next{{-1, n, 0.0}};
  for (std::size_t i = 0; i < next.size(); ++i) {
    const Share share = next[i];
    const double part = n > 1 ? static_cast<double>(share.links - 1) / (n - 1) : 1.0;
    const double radius = 0.002 + 0.088 * std::sqrt(part);
    const double length = 1.7 * std::cbrt(radius * radius / 0.0081);
    const SinCos tilt = sinCos(share.parent < 0 ? 0.0 : 0.15 + 0.2 * random.uniform(4 * i, 0, 1)),
                 turn = sinCos(share.azimuth);
    const double h = share.parent < 0 ? 0.0 : out[static_cast<std::size_t>(share.parent)].length;
    out.push_back(bar(share.parent, h, length, radius, 8e9, 900.0));
    out.back().rest = {tilt.cos, tilt.sin * turn.cos, tilt.sin * turn.sin, 0.0};
    const int rest = share.links - 1, own = static_cast<int>(i);
    const int first =
        rest < 3 ? rest : static_cast<int>(rest * random.uniform(4 * i + 1, 0.3, 0.7));
    const double azimuth = random.uniform(4 * i + 2, 0.0, 2.0 * PI);
    if (first > 0) next.push_back({own, first, azimuth});
    if (rest - first > 0) next.push_back({own, rest - first, azimuth + PI});
  }
  damp(out);
  shareInertia(out);
  return out;
}

inline double radiusOf(const Link& link) {
  return std::sqrt(link.mass / (900.0 * PI * link.length));
}

/// Returns the last link of at least 1 cm in radius, else the first.
inline std::size_t thickEnough(const std::vector<Link>& links) {
  std::size_t i = links.size() - 1;
  while (i > 0 && radiusOf(links[i]) < 0.01) --i;
  return i;
}

/// A gust of `speed` [m/s] for a second that acts on each link relative to its own motion, and a
/// pull of `pull` [N] for a second at the tip of the last link of at least 1 cm in radius.
inline Surroundings gustAndPull(const std::vector<Link>& links, double speed, double pull) {
  Surroundings out;
  std::vector<double> drag;  // [N s/m]
  for (const Link& link : links) drag.push_back(12.0 * radiusOf(link) * link.length);
  out.loads = [&links, speed, pull, drag](const Kinematics& k, double time, Loads& loads) {
    loads.drag.resize(links.size());
    const double swell = time < 1.0 ? sinCos(PI * time).sin : 0.0;
    const Vec3 wind(speed * swell * swell, 0.2 * speed * swell * swell, 0.0);
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Vec3 arm = links[i].centre.z() * axisZ(k.pose[i].orientation);
      const Vec3 velocity = k.velocity[i] + k.spin[i].cross(arm);
      const Vec3 force = drag[i] * (wind - velocity);
      loads.wrench[i] = {force, arm.cross(force)};
      loads.drag[i] = {arm, drag[i], Vec3::Zero()};
    }
    if (time >= 1.0) return;
    const std::size_t pulled = thickEnough(links);
    const Vec3 force(0.0, pull, 0.0);
    const Vec3 arm = links[pulled].length * axisZ(k.pose[pulled].orientation);
    loads.wrench[pulled].force += force;
    loads.wrench[pulled].torque += arm.cross(force);
  };
  return out;
}

/// A gust for a second whose drag is quadratic in the relative speed and acts off the links' axes.
inline Surroundings quadraticGust(const std::vector<Link>& links, double speed) {
  Surroundings out;
  out.loads = [&links, speed](const Kinematics& k, double time, Loads& loads) {
    loads.drag.resize(links.size());
    const double swell = time < 1.0 ? sinCos(PI * time).sin : 0.0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const double factor = 0.05 * links[i].length;
      const Vec3 arm = rotate(k.pose[i].orientation, Vec3(0.1, 0.0, 0.8) * links[i].length);
      const Vec3 wind =
          speed * swell * swell * Vec3(1.0, 0.3, 0.1) - k.velocity[i] - cross(k.spin[i], arm);
      const double size = length(wind);
      loads.wrench[i].force = factor * size * wind;
      loads.wrench[i].torque = cross(arm, loads.wrench[i].force);
      if (size > 0.0) loads.drag[i] = {arm, factor * size, std::sqrt(factor / size) * wind};
    }
  };
  return out;
}

/// Spreads the springs of a tree evenly in logarithms; the stiffest is `ratio` times the softest.
inline void spreadStiffness(std::vector<Link>& links, double ratio) {
  const double stiffest = links[0].stiffness, softest = links.back().stiffness;
  for (Link& link : links) {
    const double s = std::log(link.stiffness / softest) / std::log(stiffest / softest);
    const double k = stiffest * std::pow(ratio, s - 1.0);
    link.damping *= std::sqrt(k / link.stiffness);
    link.stiffness = k;
  }
}

/// The springs of a gripper, far stiffer than what they hold, two of them on one link.
inline Surroundings gripper(const std::vector<Link>& links) {
  Surroundings out;
  const Kinematics rest = kinematicsAt(links, atRest(links.size()));
  out.loads = [&links, rest](const Kinematics& k, double time, Loads& loads) {
    const std::size_t thick = thickEnough(links);
    for (const std::size_t i : {links.size() - 1, thick, thick}) {
      const auto point = [&](const Pose& pose) {
        return Vec3(pose.position + 0.7 * links[i].length * axisZ(pose.orientation));
      };
      Anchor a;
      a.link = static_cast<int>(i);
      a.arm = point(k.pose[i]) - k.pose[i].position;
      const Vec3 velocity = k.velocity[i] + k.spin[i].cross(a.arm);
      const Vec3 target = point(rest.pose[i]) + 0.1 * smootherStep(time) * Vec3(1.0, 0.5, -0.2);
      a.force = 5000.0 * (target - point(k.pose[i])) - 20.0 * velocity;
      a.stiffness = {5000.0, 5000.0, 5000.0, 0.0, 0.0, 0.0};
      a.damping = {20.0, 20.0, 20.0, 0.0, 0.0, 0.0};
      loads.anchors.push_back(a);
    }
  };
  return out;
}

inline bool sameBits(const ChainState& a, const ChainState& b) {
  for (std::size_t i = 0; i < a.q.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      if (std::memcmp(&a.q[i][axis], &b.q[i][axis], sizeof(double)) != 0 ||
          std::memcmp(&a.rate[i][axis], &b.rate[i][axis], sizeof(double)) != 0)
        return false;
  return a.q.size() == b.q.size();
}

}  // namespace vegetation_sim::physics
