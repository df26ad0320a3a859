// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/reference.h"

#include <array>
#include <cmath>
#include <limits>

namespace vegetation_sim::bench {
namespace {

using Mat3 = Eigen::Matrix3d;
using Axes = Eigen::Matrix<double, 3, 2>;

Mat3 cross(const Vec3& v) {
  Mat3 out;
  out << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return out;
}

Mat3 matrixOf(const Quat& q) {
  Mat3 out;
  out << axisX(q), axisY(q), axisZ(q);
  return out;
}

// Rotation and axes of two bends in the rest frame, and the part of the relative angular
// acceleration, in that frame, that is quadratic in the rates.
struct Turn {
  Mat3 rotation;
  Axes axes;
  Vec3 bias;
};

Turn hinges(double a, double b, double ra, double rb) {
  Turn out;
  out.rotation = Eigen::AngleAxisd(a, Vec3::UnitX()) * Eigen::AngleAxisd(b, Vec3::UnitY());
  out.axes.col(0) = Vec3::UnitX();
  out.axes.col(1) = Vec3(0.0, std::cos(a), std::sin(a));
  out.bias = ra * rb * Vec3(0.0, -std::sin(a), std::cos(a));
  return out;
}

// Computes exp(q) and its left Jacobian 1 + A [q] + B [q]^2, A = (1 - cos t) / t^2, B = (t - sin t)
// / t^3.
Turn swing(double a, double b, double ra, double rb) {
  const Vec3 q(a, b, 0.0), rate(ra, rb, 0.0);
  const double t2 = q.squaredNorm(), t = std::sqrt(t2);
  double A, B, dA, dB;  // dA, dB: derivatives by t, over t
  if (t < 0.02) {
    A = 0.5 - t2 / 24.0 + t2 * t2 / 720.0;
    B = 1.0 / 6.0 - t2 / 120.0 + t2 * t2 / 5040.0;
    dA = -1.0 / 12.0 + t2 / 180.0;
    dB = -1.0 / 60.0 + t2 / 1260.0;
  } else {
    A = (1.0 - std::cos(t)) / t2;
    B = (t - std::sin(t)) / (t2 * t);
    dA = (std::sin(t) / t - 2.0 * A) / t2;
    dB = (A - 3.0 * B) / t2;
  }
  const Mat3 K = cross(q), K2 = K * K;
  const Mat3 jacobian = Mat3::Identity() + A * K + B * K2;
  const double along = q.dot(rate);
  Turn out;
  out.rotation = Mat3::Identity() +
                 (t < 0.02 ? 1.0 - t2 / 6.0 + t2 * t2 / 120.0 : std::sin(t) / t) * K + A * K2;
  out.axes = jacobian.leftCols<2>();
  const Vec3 turned = q.cross(rate);
  out.bias = dA * along * turned + dB * along * q.cross(turned) + B * rate.cross(turned);
  return out;
}

// A force that starts or ends at once makes stiff twigs oscillate, which their dampers soon end;
// nearly all of the error arises there. A gust is smooth.
int stepsOf(const TestLoad& load, int interval, int steps) {
  const int after = interval < LOADED_INTERVALS ? interval : interval - LOADED_INTERVALS;
  return load.kind == TestLoad::Kind::PULL && after < 8 ? 8 * steps / (1 + after) : steps;
}

}  // namespace

const char* nameOf(Bend bend) {
  return bend == Bend::SWING ? "swing" : "hinges";
}

struct ReferenceChain::Joint {
  Mat3 rest, turn;            // rest in the parent's axes; world
  Vec3 position, spin, zeta;  // zeta: angular acceleration from the rates
  Vec3 arm, centripetal;      // from the parent's joint; of the joint
  Axes axes;
  Mat3 A, B, M;        // articulated inertia about the joint: [A B; B^T M]
  Vec3 torque, force;  // its bias
  Axes K, L;           // torque and force per joint acceleration
  Eigen::Matrix2d inverse;
  Eigen::Vector2d drive;
  Vec3 spin_rate, acceleration;
};

ReferenceChain::~ReferenceChain() = default;

ReferenceChain::ReferenceChain(const TestTree& tree, const TestLoad& load, Bend bend)
    : tree_(tree), load_(load), bend_(bend), joints_(tree.links.size()), tips_(tree.tips()) {
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i].rest = matrixOf(tree.links[i].rest);
}

void ReferenceChain::turnOut(const State& state) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const TestLink& link = tree_.links[i];
    Joint& j = joints_[i];
    const Joint* bearer =
        link.parent < 0 ? nullptr : &joints_[static_cast<std::size_t>(link.parent)];
    const Mat3 frame = bearer ? Mat3(bearer->turn * j.rest) : j.rest;
    const Vec3 spin = bearer ? bearer->spin : Vec3(Vec3::Zero());
    const double* s = &state[4 * i];
    const Turn turn =
        bend_ == Bend::SWING ? swing(s[0], s[1], s[2], s[3]) : hinges(s[0], s[1], s[2], s[3]);
    j.arm = bearer ? Vec3(bearer->turn.col(2) * link.h) : Vec3(0.0, 0.0, link.h);
    j.position = bearer ? Vec3(bearer->position + j.arm) : j.arm;
    j.centripetal = spin.cross(spin.cross(j.arm));
    j.turn = frame * turn.rotation;
    j.axes = frame * turn.axes;
    const Vec3 relative = j.axes * Eigen::Vector2d(s[2], s[3]);
    j.spin = spin + relative;
    j.zeta = spin.cross(relative) + frame * turn.bias;
    const Vec3 axis = j.turn.col(2), moment = 0.5 * link.length * link.mass * axis;
    j.A = link.across * Mat3::Identity() + (link.along - link.across) * axis * axis.transpose();
    j.B = cross(moment);
    j.M = link.mass * Mat3::Identity();
    j.torque = j.spin.cross(j.A * j.spin);
    j.force = j.spin.cross(j.spin.cross(moment));
  }
}

void ReferenceChain::load(double factor) {
  if (factor == 0.0) return;
  for (std::size_t i = 0; i < load_.links.size(); ++i) {
    Joint& j = joints_[static_cast<std::size_t>(load_.links[i])];
    const Vec3 force = factor * load_.force[i];
    j.force -= force;
    j.torque -= load_.along[i] * j.turn.col(2).cross(force);
  }
}

void ReferenceChain::sweepIn(const State& state) {
  for (std::size_t i = joints_.size(); i-- > 0;) {
    const TestLink& link = tree_.links[i];
    Joint& j = joints_[i];
    const double* s = &state[4 * i];
    j.K = j.A * j.axes;
    j.L = j.B.transpose() * j.axes;
    j.inverse = (j.axes.transpose() * j.K).inverse();
    const Eigen::Vector2d tau(-link.stiffness * s[0] - link.damping * s[2],
                              -link.stiffness * s[1] - link.damping * s[3]);
    j.drive = tau - j.axes.transpose() * j.torque;
    if (link.parent < 0) continue;
    const Axes KD = j.K * j.inverse, LD = j.L * j.inverse;
    const Mat3 A = j.A - KD * j.K.transpose(), B = j.B - KD * j.L.transpose(),
               M = j.M - LD * j.L.transpose(), r = cross(j.arm);
    const Vec3 torque = j.torque + KD * j.drive + A * j.zeta + B * j.centripetal;
    const Vec3 force = j.force + LD * j.drive + B.transpose() * j.zeta + M * j.centripetal;
    Joint& p = joints_[static_cast<std::size_t>(link.parent)];
    const Mat3 shifted = B + r * M;
    p.A += A - B * r + r * shifted.transpose();
    p.B += shifted;
    p.M += M;
    p.torque += torque + j.arm.cross(force);
    p.force += force;
  }
}

void ReferenceChain::sweepOut(const State& state, State& derivative) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const int parent = tree_.links[i].parent;
    Joint& j = joints_[i];
    const Joint* bearer = parent < 0 ? nullptr : &joints_[static_cast<std::size_t>(parent)];
    const Vec3 rate = (bearer ? bearer->spin_rate : Vec3(Vec3::Zero()));
    const Vec3 carried = rate + j.zeta;
    j.acceleration = bearer ? Vec3(bearer->acceleration + rate.cross(j.arm) + j.centripetal)
                            : Vec3(Vec3::Zero());
    const Eigen::Vector2d bend =
        j.inverse * (j.drive - j.K.transpose() * carried - j.L.transpose() * j.acceleration);
    j.spin_rate = carried + j.axes * bend;
    derivative[4 * i] = state[4 * i + 2];
    derivative[4 * i + 1] = state[4 * i + 3];
    derivative[4 * i + 2] = bend.x();
    derivative[4 * i + 3] = bend.y();
  }
}

void ReferenceChain::derive(int interval, double time, const State& state, State& derivative) {
  turnOut(state);
  load(load_.factor(interval, time));
  sweepIn(state);
  sweepOut(state, derivative);
}

void ReferenceChain::step(int interval, double time, double h, State& state) {
  static thread_local std::array<State, 4> k;
  static thread_local State at;
  for (State& each : k) each.resize(state.size());
  at.resize(state.size());
  const double part[4] = {0.0, 0.5, 0.5, 1.0};
  for (std::size_t stage = 0; stage < 4; ++stage) {
    const State& before = k[stage == 0 ? 0 : stage - 1];
    for (std::size_t i = 0; i < at.size(); ++i)
      at[i] = stage == 0 ? state[i] : state[i] + part[stage] * h * before[i];
    derive(interval, time + part[stage] * h, at, k[stage]);
  }
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] += h / 6.0 * (k[0][i] + 2.0 * (k[1][i] + k[2][i]) + k[3][i]);
}

std::vector<Vec3> ReferenceChain::tipPositions() const {
  std::vector<Vec3> out;
  for (const int tip : tips_) {
    const auto i = static_cast<std::size_t>(tip);
    out.push_back(joints_[i].position + tree_.links[i].length * joints_[i].turn.col(2));
  }
  return out;
}

std::vector<Vec3> ReferenceChain::tips(const State& state) {
  turnOut(state);
  return tipPositions();
}

Motion ReferenceChain::run(int steps, int intervals) {
  State state(4 * joints_.size(), 0.0);
  Motion out;
  for (int interval = 0; interval < intervals; ++interval) {
    const int parts = stepsOf(load_, interval, steps);
    const double h = INTERVAL / parts;
    for (int i = 0; i < parts; ++i) step(interval, INTERVAL * interval + h * i, h, state);
    out.push_back(tips(state));
    for (const Vec3& tip : out.back())
      if (!(tip.squaredNorm() < 1e4)) return {};
  }
  return out;
}

double relativeError(const Motion& motion, const Reference& reference) {
  if (motion.empty()) return std::numeric_limits<double>::infinity();
  double error = 0.0, size = 0.0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    for (std::size_t i = 0; i < motion[k].size(); ++i) {
      error += (motion[k][i] - reference.motion[k][i]).squaredNorm();
      size += (reference.motion[k][i] - reference.rest[0][i]).squaredNorm();
    }
  }
  return std::sqrt(error / size);
}

}  // namespace vegetation_sim::bench
