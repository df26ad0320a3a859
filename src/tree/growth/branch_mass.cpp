// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/growth/branch_mass.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/tree/growth/response.h"

namespace vegetation_sim::forest {
namespace {

using Rows = std::array<Vec3, 3>;

// Returns the inertia in other axes: turn * inertia * turn^T, in written order.
std::array<double, 6> turned(const std::array<double, 6>& i, const Quat& turn) {
  const Vec3 x = axisX(turn), y = axisY(turn), z = axisZ(turn);
  const Rows rows{Vec3(i[0], i[3], i[4]), Vec3(i[3], i[1], i[5]), Vec3(i[4], i[5], i[2])};
  const Rows to{Vec3(x.x(), y.x(), z.x()), Vec3(x.y(), y.y(), z.y()), Vec3(x.z(), y.z(), z.z())};
  const auto element = [&](std::size_t a, std::size_t b) {
    const Vec3 half(dot(rows[0], to[b]), dot(rows[1], to[b]), dot(rows[2], to[b]));
    return dot(to[a], half);
  };
  return {element(0, 0), element(1, 1), element(2, 2), element(0, 1), element(0, 2), element(1, 2)};
}

Composite bar(const Branch& b, const Species& s) {
  const double radius = 0.5 * (b.base_radius + b.tip_radius), r2 = radius * radius;
  const double wood = s.density * PI * r2 * b.length, leaves = b.leaves * s.leaf_mass;
  Composite out;
  out.mass = (wood + leaves) * (1.0 + addedMass(s));
  out.moment = Vec3(0.0, 0.0, 0.5 * b.length * out.mass);
  const double across = out.mass * b.length * b.length / 3.0 + 0.25 * wood * r2;
  out.inertia = {across, across, 0.5 * wood * r2, 0.0, 0.0, 0.0};
  out.drag = dragPerSpeed(b, s);
  out.drag_moment = Vec3(0.0, 0.0, 0.5 * b.length * out.drag);
  return out;
}

// Position and rotation of a branch's joint in the axes of its parent at rest.
Composite onParent(const Branch& b, const Composite& body) {
  return body.movedBy(b.turn, Vec3(0.0, 0.0, b.h));
}

}  // namespace

double dragPerSpeed(const Branch& b, const Species& s) {
  const double area = (b.base_radius + b.tip_radius) * b.length + b.leaves * s.leaf_area;
  return 0.5 * s.fluid_density * s.drag_coefficient * area * s.reference_speed;
}

double jointStiffness(const Branch& b, const Species& s) {
  const double r2 = b.base_radius * b.base_radius;
  return s.youngs_modulus * PI * r2 * r2 / (4.0 * b.length);
}

double addedMass(const Species& species) {
  return (species.fluid_density - AIR_DENSITY) / species.density;
}

Composite Composite::movedBy(const Quat& turn, const Vec3& o) const {
  Composite out;
  out.mass = mass;
  out.drag = drag;
  const Vec3 m = rotate(turn, moment);
  out.moment = m + mass * o;
  out.drag_moment = rotate(turn, drag_moment) + drag * o;
  out.inertia = turned(inertia, turn);
  // Parallel axes: 2 (m.o) 1 - (m o^T + o m^T) + mass (o.o 1 - o o^T).
  const double spread = 2.0 * dot(m, o) + mass * dot(o, o);
  const auto cross = [&](int a, int b) { return m[a] * o[b] + o[a] * m[b] + mass * o[a] * o[b]; };
  for (int a = 0; a < 3; ++a) out.inertia[static_cast<std::size_t>(a)] += spread - cross(a, a);
  out.inertia[3] -= cross(0, 1);
  out.inertia[4] -= cross(0, 2);
  out.inertia[5] -= cross(1, 2);
  return out;
}

void Composite::add(const Composite& other) {
  mass += other.mass;
  moment += other.moment;
  for (std::size_t i = 0; i < inertia.size(); ++i) inertia[i] += other.inertia[i];
  drag += other.drag;
  drag_moment += other.drag_moment;
}

Wood woodOf(const Skeleton& skeleton, const Species& species, Material material) {
  const std::size_t n = skeleton.branches.size();
  Wood out;
  out.added_mass = addedMass(species);
  out.own.resize(n);
  out.stiffness.resize(n);
  out.damping.resize(n);
  out.reach.resize(n);
  for (std::size_t i = 0; i < n; ++i) out.own[i] = bar(skeleton.branches[i], species);
  clusterWood(skeleton, out.own, std::vector<char>(n, 0), out.subtree);
  for (std::size_t i = n; i-- > 0;) {
    const Branch& b = skeleton.branches[i];
    const bool paper = material == Material::PAPER;
    const double ratio = paper ? PAPER_RADIUS / b.base_radius : 1.0;
    out.stiffness[i] = jointStiffness(b, species) * ratio * ratio;
    const double across = std::max(out.subtree[i].inertia[0], out.subtree[i].inertia[1]);
    out.damping[i] = paper ? species.damping_ratio * PAPER_DAMPING * out.stiffness[i]
                           : 2.0 * species.damping_ratio * std::sqrt(out.stiffness[i] * across);
    out.reach[i] = std::max(out.reach[i], b.length);
    if (b.parent < 0) continue;
    double& below = out.reach[static_cast<std::size_t>(b.parent)];
    below = std::max(below, b.h + out.reach[i]);
  }
  return out;
}

void clusterWood(const Skeleton& skeleton, const std::vector<Composite>& own,
                 const std::vector<char>& promoted, std::vector<Composite>& out) {
  out = own;
  for (std::size_t i = out.size(); i-- > 0;) {
    const Branch& b = skeleton.branches[i];
    if (b.parent < 0 || promoted[i]) continue;
    out[static_cast<std::size_t>(b.parent)].add(onParent(b, out[i]));
  }
}

}  // namespace vegetation_sim::forest
