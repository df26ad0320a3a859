// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/growth/response.h"

#include <cmath>

#include "dynamics/chain/bend.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

// Torque on a joint per wind velocity v is `lever` x v: drag of the sub-tree times its arm [kg
// m/s].
std::vector<Vec3> subtreeLevers(const Skeleton& skeleton, const Species& species) {
  const std::size_t n = skeleton.branches.size();
  std::vector<double> drag(n);
  std::vector<Vec3> moment(n);  // sum of drag * centre
  for (std::size_t i = 0; i < n; ++i) {
    const Branch& b = skeleton.branches[i];
    drag[i] = dragPerSpeed(b, species);
    moment[i] = drag[i] * (b.rest.position + 0.5 * b.length * axisZ(b.rest.orientation));
  }
  std::vector<Vec3> lever(n);
  for (std::size_t i = n; i-- > 0;) {
    const Branch& b = skeleton.branches[i];
    lever[i] = moment[i] - drag[i] * b.rest.position;
    if (b.parent < 0) continue;
    drag[static_cast<std::size_t>(b.parent)] += drag[i];
    moment[static_cast<std::size_t>(b.parent)] += moment[i];
  }
  return lever;
}

}  // namespace

std::vector<Response> windResponse(const Skeleton& skeleton, const Species& species,
                                   const MotionLaw& law) {
  const bool paper_gain = law.gain == Gain::PAPER;
  const bool paper_joint = law.joint_model == JointModel::PAPER;
  std::vector<Vec3> levers;
  if (!paper_gain) levers = subtreeLevers(skeleton, species);
  std::vector<Response> out(skeleton.branches.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Branch& b = skeleton.branches[i];
    const Quat& q = b.rest.orientation;
    Vec3 lever;  // [rad s/m]
    if (paper_gain) {
      const double mean_radius = 0.5 * (b.base_radius + b.tip_radius);
      const double mass = species.density * PI * mean_radius * mean_radius * b.length;
      lever = (PAPER_GAIN * b.length / mass) * axisZ(q);
    } else {
      lever = levers[i] / jointStiffness(b, species);
    }
    const Vec3 parent_z =
        b.parent < 0
            ? Vec3(0.0, 0.0, 1.0)
            : axisZ(skeleton.branches[static_cast<std::size_t>(b.parent)].rest.orientation);
    // axis . (lever x v) = (axis x lever) . v
    out[i].first = cross(paper_joint ? parent_z : axisX(q), lever);
    out[i].second = cross(axisY(q), lever);
  }
  return out;
}

Vec3 effectiveVelocity(const Vec3& velocity, Drag drag, double reference_speed) {
  return drag == Drag::LINEAR ? velocity : Vec3(velocity * (length(velocity) / reference_speed));
}

JointAngles deviation(const Response& response, const Vec3& velocity, double weight,
                      JointModel model) {
  const double a = dot(response.first, velocity), b = dot(response.second, velocity);
  if (model == JointModel::PAPER)
    return {weight * softLimit(a, BEND_KNEE, BEND_LIMIT),
            weight * softLimit(b, BEND_KNEE, BEND_LIMIT)};
  const double magnitude = std::sqrt(a * a + b * b);
  if (magnitude <= BEND_KNEE) return {weight * a, weight * b};
  const double scale = weight * softLimit(magnitude, BEND_KNEE, BEND_LIMIT) / magnitude;
  return {scale * a, scale * b};
}

Quat jointRotation(const Branch& branch, const JointAngles& angles, JointModel model) {
  if (model == JointModel::PAPER)
    return restRotation(branch.theta + angles.first, branch.phi + angles.second);
  return branch.turn * physics::bendRotation({angles.first, angles.second});
}

}  // namespace vegetation_sim::forest
