// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/chain/articulated.h"
#include "dynamics/chain/articulated_body.h"

namespace vegetation_sim::physics {

// Computes what the joints must do under the wrenches in bodies_ alone, with unchanged inertias.
void ArticulatedBody::sweepWrenches(const Links& links) {
  for (std::size_t i = links.size(); i-- > 0;) {
    const Joint& joint = joints_[i];
    Body& body = bodies_[i];
    Gain& gain = gains_[i];
    gain.drive1 = -dot(joint.first, body.torque);
    gain.drive2 = -dot(joint.second, body.torque) - gain.coupling * gain.drive1;
    if (links[i].parent < 0) continue;
    Body& parent = bodies_[static_cast<std::size_t>(links[i].parent)];
    const double x1 = gain.inverse1 * gain.drive1, x2 = gain.inverse2 * gain.drive2;
    const Vec3 force = body.force + x1 * gain.b1 + x2 * gain.b2;
    parent.torque += body.torque + x1 * gain.a1 + x2 * gain.a2 + cross(joint.offset, force);
    parent.force += force;
  }
}

// The wrenches change by half of the change of the links' bias; the response of the chain stays the
// same.
void ArticulatedBody::averageProducts(const std::vector<Link>& links,
                                      const std::vector<BaseMotion>& bases, const ChainState& state,
                                      const Kinematics& k, double h, std::vector<Vec2>& out) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const bool root = link.parent < 0;
    const auto p = static_cast<std::size_t>(root ? 0 : link.parent);
    const BaseMotion& base = baseOf(link, bases);
    const Vec3 parent = root ? base.spin : Vec3(k.spin[p] + h * push_[p].spin);
    const Vec3 spin = k.spin[i] + h * push_[i].spin;
    const Joint& joint = joints_[i];
    const Vec3 sweep = cross(spin, joint.axes.z);
    const Vec3 change = bendBias(joint.bend, state.q[i], state.rate[i] + h * out[i], joint.axes) +
                        cross(parent, spin - parent);
    FreeMotion ground;
    if (root) ground = freeMotionOf(base, 1.0);
    freeMotion(root ? ground : free_[p], link.h, change, spin, sweep, joint.axes.z, 1.0, free_[i]);
    const Wrench bias = biasOf(link, joint.axes, spin, sweep, free_[i], 1.0);
    bodies_[i].torque = 0.5 * (bias.torque - bias_[i].torque);
    bodies_[i].force = 0.5 * (bias.force - bias_[i].force);
  }
  sweepWrenches(links);
  settle(links, change_);
  for (std::size_t i = 0; i < links.size(); ++i) out[i] += change_[i];
}

}  // namespace vegetation_sim::physics
