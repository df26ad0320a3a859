// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/physical_tree.h"

#include <cmath>

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/forest/response.h"

namespace vegetation_sim::forest {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Matrix32 = Eigen::Matrix<double, 3, 2>;

Matrix3 crossMatrix(const Vec3& v) {
  Matrix3 out;
  out << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return out;
}

Matrix3 rotationMatrix(const Quat& q) {
  Matrix3 out;
  out.col(0) = axisX(q);
  out.col(1) = axisY(q);
  out.col(2) = axisZ(q);
  return out;
}

// exp of the rotation vector (x, y, 0).
Quat swingRotation(const Eigen::Vector2d& q) {
  const double angle = std::sqrt(q.x() * q.x() + q.y() * q.y());
  if (angle < 1e-9) return {1.0, 0.5 * q.x(), 0.5 * q.y(), 0.0};
  const SinCos half = sinCos(0.5 * angle);
  const double s = half.sin / angle;
  return {half.cos, s * q.x(), s * q.y(), 0.0};
}

// (1 - cos a) / a^2, (a - sin a) / a^3 and their derivatives by a, divided by a.
struct RotationSeries {
  double b, c, db, dc;
};

RotationSeries rotationSeries(double angle) {
  const double a2 = angle * angle;
  if (angle < 0.05)
    return {0.5 - a2 / 24.0 + a2 * a2 / 720.0, 1.0 / 6.0 - a2 / 120.0 + a2 * a2 / 5040.0,
            -1.0 / 12.0 + a2 / 180.0 - a2 * a2 / 6720.0,
            -1.0 / 60.0 + a2 / 1260.0 - a2 * a2 / 60480.0};
  const SinCos s = sinCos(angle);
  const double b = (1.0 - s.cos) / a2, c = (angle - s.sin) / (a2 * angle);
  return {b, c, (s.sin / angle - 2.0 * b) / a2, (b - 3.0 * c) / a2};
}

/// Axes of a joint in the child's frame: spin = axes * rate, and their rate of change * rate.
struct JointMotion {
  Matrix32 axes;
  Vec3 bias;
};

// Right Jacobian of the rotation vector w = (q, 0): I - b [w] + c [w]^2.
JointMotion jointMotion(const Eigen::Vector2d& q, const Eigen::Vector2d& rate) {
  const Vec3 w(q.x(), q.y(), 0.0), rate3(rate.x(), rate.y(), 0.0);
  const RotationSeries s = rotationSeries(std::sqrt(dot(w, w)));
  const Matrix3 cross = crossMatrix(w), cross_rate = crossMatrix(rate3);
  const Matrix3 full = Matrix3::Identity() - s.b * cross + s.c * cross * cross;
  const double swept = dot(w, rate3);  // angle times its rate
  const Matrix3 change = -s.db * swept * cross - s.b * cross_rate + s.dc * swept * cross * cross +
                         s.c * (cross_rate * cross + cross * cross_rate);
  return {full.leftCols<2>(), Vec3(change * rate3)};
}

/// Articulated inertia about a joint: torque = a * spin' + b * acceleration,
/// force = b^T * spin' + m * acceleration; and the bias wrench.
struct Articulated {
  Matrix3 a, b, m;
  Vec3 torque, force;
};

Articulated rigidBody(const PhysicalBranch& branch, const Pose& pose, const Vec3& spin,
                      const Wrench& load) {
  const Matrix3 turn = rotationMatrix(pose.orientation);
  const Vec3 arm = branch.centre * turn.col(2);
  const Vec3 diagonal(branch.inertia_across, branch.inertia_across, branch.inertia_along);
  Articulated out;
  out.a = turn * diagonal.asDiagonal() * turn.transpose();
  out.b = branch.mass * crossMatrix(arm);
  out.m = branch.mass * Matrix3::Identity();
  out.torque = spin.cross(Vec3(out.a * spin)) - load.torque;
  out.force = branch.mass * spin.cross(spin.cross(arm)) - load.force;
  return out;
}

// Adds what a child, already projected on its joint, puts on its parent's joint `offset` away.
void addChild(const Articulated& child, const Vec3& offset, Articulated& parent) {
  const Matrix3 d = crossMatrix(offset);
  const Matrix3 db = d * child.b.transpose();
  parent.a += child.a + db + db.transpose() - d * child.m * d;
  parent.b += child.b + d * child.m;
  parent.m += child.m;
  parent.torque += child.torque + offset.cross(child.force);
  parent.force += child.force;
}

/// One joint between the two passes.
struct Sweep {
  Vec3 offset;                                 // from the parent's joint, world
  Matrix32 axes;                               // world
  Vec3 spin_bias;                              // of the spin's rate of change
  Vec3 linear_bias;                            // of the joint's acceleration
  Eigen::Matrix<double, 3, 2> gain_a, gain_b;  // inertia * axes
  Eigen::Matrix2d inverse;
  Eigen::Vector2d torque;
};

}  // namespace

Kinematics kinematicsOf(const std::vector<PhysicalBranch>& tree, const PhysicalState& state) {
  const std::size_t n = tree.size();
  Kinematics out{std::vector<Pose>(n), std::vector<Vec3>(n), std::vector<Vec3>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const PhysicalBranch& branch = tree[i];
    Pose base;
    Vec3 spin = Vec3::Zero(), velocity = Vec3::Zero();
    if (branch.parent >= 0) {
      const auto p = static_cast<std::size_t>(branch.parent);
      const Vec3 offset = branch.h * axisZ(out.pose[p].orientation);
      base = {out.pose[p].position + offset, out.pose[p].orientation};
      spin = out.spin[p];
      velocity = out.velocity[p] + spin.cross(offset);
    }
    out.pose[i].position = base.position;
    out.pose[i].orientation = base.orientation * branch.rest * swingRotation(state.q[i]);
    const JointMotion joint = jointMotion(state.q[i], state.rate[i]);
    out.spin[i] = spin + rotate(out.pose[i].orientation, Vec3(joint.axes * state.rate[i]));
    out.velocity[i] = velocity;
  }
  return out;
}

double energyOf(const std::vector<PhysicalBranch>& tree, const PhysicalState& state) {
  const Kinematics k = kinematicsOf(tree, state);
  double sum = 0.0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Articulated body = rigidBody(tree[i], k.pose[i], Vec3::Zero(), Wrench());
    sum += 0.5 * k.spin[i].dot(body.a * k.spin[i]) + k.spin[i].dot(body.b * k.velocity[i]) +
           0.5 * tree[i].mass * k.velocity[i].squaredNorm();
    sum += 0.5 * tree[i].stiffness * state.q[i].squaredNorm();
  }
  return sum;
}

std::vector<Eigen::Vector2d> articulatedAccelerations(const std::vector<PhysicalBranch>& tree,
                                                      const PhysicalState& state,
                                                      const std::vector<Wrench>& loads,
                                                      const Implicitness& implicitness) {
  const std::size_t n = tree.size();
  const Kinematics k = kinematicsOf(tree, state);
  std::vector<Articulated> bodies(n);
  std::vector<Sweep> sweeps(n);
  for (std::size_t i = 0; i < n; ++i) {
    bodies[i] = rigidBody(tree[i], k.pose[i], k.spin[i], loads[i]);
    const JointMotion joint = jointMotion(state.q[i], state.rate[i]);
    Sweep& s = sweeps[i];
    for (int c = 0; c < 2; ++c)
      s.axes.col(c) = rotate(k.pose[i].orientation, Vec3(joint.axes.col(c)));
    const bool grounded = tree[i].parent < 0;
    const auto p = static_cast<std::size_t>(grounded ? 0 : tree[i].parent);
    const Vec3 spin = grounded ? Vec3(Vec3::Zero()) : k.spin[p];
    s.offset = grounded ? Vec3(Vec3::Zero()) : Vec3(k.pose[i].position - k.pose[p].position);
    s.linear_bias = spin.cross(spin.cross(s.offset));
    s.spin_bias =
        rotate(k.pose[i].orientation, joint.bias) + spin.cross(Vec3(s.axes * state.rate[i]));
  }
  for (std::size_t i = n; i-- > 0;) {
    const PhysicalBranch& branch = tree[i];
    Articulated& body = bodies[i];
    Sweep& s = sweeps[i];
    s.gain_a = body.a * s.axes;
    s.gain_b = body.b.transpose() * s.axes;
    Eigen::Matrix2d inertia = s.axes.transpose() * s.gain_a;
    inertia.diagonal().array() +=
        implicitness.second * branch.stiffness + implicitness.third * branch.damping;
    s.inverse = inertia.inverse();
    const Eigen::Vector2d spring =
        -branch.stiffness * (state.q[i] + implicitness.first * state.rate[i]) -
        branch.damping * state.rate[i];
    // Bias wrench with the parts of the acceleration that are known already.
    body.torque += body.a * s.spin_bias + body.b * s.linear_bias;
    body.force += body.b.transpose() * s.spin_bias + body.m * s.linear_bias;
    s.torque = spring - s.axes.transpose() * body.torque;
    if (branch.parent < 0) continue;
    const Eigen::Matrix<double, 3, 2> weighted_a = s.gain_a * s.inverse;
    const Eigen::Matrix<double, 3, 2> weighted_b = s.gain_b * s.inverse;
    Articulated passed;
    passed.a = body.a - weighted_a * s.gain_a.transpose();
    passed.b = body.b - weighted_a * s.gain_b.transpose();
    passed.m = body.m - weighted_b * s.gain_b.transpose();
    passed.torque = body.torque + weighted_a * s.torque;
    passed.force = body.force + weighted_b * s.torque;
    addChild(passed, s.offset, bodies[static_cast<std::size_t>(branch.parent)]);
  }
  std::vector<Eigen::Vector2d> out(n);
  std::vector<Vec3> spin_rate(n), acceleration(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Sweep& s = sweeps[i];
    Vec3 spin = Vec3::Zero(), linear = Vec3::Zero();
    if (tree[i].parent >= 0) {
      const auto p = static_cast<std::size_t>(tree[i].parent);
      spin = spin_rate[p];
      linear = acceleration[p] + spin_rate[p].cross(s.offset);
    }
    out[i] = s.inverse * (s.torque - s.gain_a.transpose() * spin - s.gain_b.transpose() * linear);
    spin_rate[i] = spin + s.spin_bias + s.axes * out[i];
    acceleration[i] = linear + s.linear_bias;
  }
  return out;
}

}  // namespace vegetation_sim::forest
