// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/chain/linear_chain.h"

#include "dynamics/chain/articulated.h"
#include "dynamics/chain/symmetric.h"

namespace vegetation_sim::physics {

LinearChain::LinearChain(const std::vector<Link>& links)
    : links_(links.size()), motion_(links.size()), momentum_(links.size()) {
  const std::vector<Vec2> none(links.size(), Vec2::Zero());
  Kinematics kinematics;
  kinematicsOf(links, {}, {none, none}, kinematics);
  rest_ = kinematics.pose;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const Quat& q = rest_[i].orientation;
    Node& node = links_[i];
    node.parent = link.parent;
    node.first = axisX(q);
    node.second = axisY(q);
    node.offset = rest_[i].position;
    if (link.parent >= 0) node.offset -= rest_[static_cast<std::size_t>(link.parent)].position;
    node.moment = link.mass * rotate(q, link.centre);
    node.inertia = turned(link.inertia, node.first, node.second, axisZ(q));
    node.mass = link.mass;
    stiffness_.insert(stiffness_.end(), 2, link.stiffness);
    damping_.insert(damping_.end(), 2, link.damping);
  }
}

void LinearChain::motionOf(const double* x, std::vector<SmallMotion>& out) const {
  out.resize(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Node& node = links_[i];
    SmallMotion& motion = out[i];
    motion.turn = x[2 * i] * node.first + x[2 * i + 1] * node.second;
    motion.move.setZero();
    if (node.parent < 0) continue;
    const SmallMotion& bearer = out[static_cast<std::size_t>(node.parent)];
    motion.turn += bearer.turn;
    motion.move = bearer.move + cross(bearer.turn, node.offset);
  }
}

// Sums the momentum of every link that moves by x towards the root, about each joint.
void LinearChain::timesMass(const double* x, double* out) {
  motionOf(x, motion_);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Node& node = links_[i];
    const SmallMotion& motion = motion_[i];
    momentum_[i].force = node.mass * motion.move + cross(motion.turn, node.moment);
    momentum_[i].torque = multiply(node.inertia, motion.turn) + cross(node.moment, motion.move);
  }
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Node& node = links_[i];
    const Wrench& own = momentum_[i];
    out[2 * i] = dot(node.first, own.torque);
    out[2 * i + 1] = dot(node.second, own.torque);
    if (node.parent < 0) continue;
    Wrench& bearer = momentum_[static_cast<std::size_t>(node.parent)];
    bearer.force += own.force;
    bearer.torque += own.torque + cross(node.offset, own.force);
  }
}

std::vector<double> LinearChain::torquesOf(const std::vector<Wrench>& wrenches) const {
  std::vector<Wrench> sum = wrenches;
  std::vector<double> out(size());
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Node& node = links_[i];
    out[2 * i] = dot(node.first, sum[i].torque);
    out[2 * i + 1] = dot(node.second, sum[i].torque);
    if (node.parent < 0) continue;
    Wrench& bearer = sum[static_cast<std::size_t>(node.parent)];
    bearer.force += sum[i].force;
    bearer.torque += sum[i].torque + cross(node.offset, sum[i].force);
  }
  return out;
}

}  // namespace vegetation_sim::physics
