// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/forest/physical_tree.h"
#include "vegetation_sim/forest/response.h"

namespace vegetation_sim::forest {
namespace {

// Inertia of each branch's whole sub-tree about its joint, across its own axis, at rest [kg m^2].
std::vector<double> subtreeInertias(const Skeleton& skeleton,
                                    const std::vector<PhysicalBranch>& tree) {
  const std::size_t n = tree.size();
  std::vector<double> mass(n), second(n);  // second moment of mass about the own joint, spherical
  std::vector<Vec3> moment(n, Vec3::Zero());
  std::vector<double> out(n);
  for (std::size_t i = n; i-- > 0;) {
    const Vec3 axis = axisZ(skeleton.branches[i].rest.orientation);
    mass[i] += tree[i].mass;
    moment[i] += tree[i].mass * tree[i].centre * axis;
    second[i] += tree[i].inertia_across;
    out[i] = second[i];
    if (tree[i].parent < 0) continue;
    const auto p = static_cast<std::size_t>(tree[i].parent);
    const Vec3 arm = skeleton.branches[i].rest.position - skeleton.branches[p].rest.position;
    mass[p] += mass[i];
    second[p] += second[i] + 2.0 * dot(arm, moment[i]) + mass[i] * dot(arm, arm);
    moment[p] += moment[i] + mass[i] * arm;
  }
  return out;
}

}  // namespace

std::vector<PhysicalBranch> beamTree(const Skeleton& skeleton, const Species& species,
                                     double damping_ratio) {
  std::vector<PhysicalBranch> out(skeleton.branches.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Branch& b = skeleton.branches[i];
    const double radius = 0.5 * (b.base_radius + b.tip_radius);
    out[i].parent = b.parent;
    out[i].h = b.h;
    out[i].rest = restRotation(b.theta, b.phi);
    out[i].length = b.length;
    out[i].mass = species.density * PI * radius * radius * b.length;
    out[i].centre = 0.5 * b.length;
    out[i].inertia_across = out[i].mass * (b.length * b.length / 3.0 + radius * radius / 4.0);
    out[i].inertia_along = 0.5 * out[i].mass * radius * radius;
    out[i].stiffness = jointStiffness(b, species);
  }
  const std::vector<double> inertia = subtreeInertias(skeleton, out);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].damping = 2.0 * damping_ratio * std::sqrt(out[i].stiffness * inertia[i]);
  return out;
}

}  // namespace vegetation_sim::forest
