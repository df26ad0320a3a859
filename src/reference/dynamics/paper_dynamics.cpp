// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/dynamics/paper_dynamics.h"

#include "dynamics/chain/symmetric.h"

namespace vegetation_sim::physics {
namespace {

struct Rows {
  Vec3 x, y, z;
};

Rows inverse(const Vec3& x, const Vec3& y, const Vec3& z) {
  const Vec3 a = cross(y, z), b = cross(z, x), c = cross(x, y);  // columns, times the determinant
  const double scale = 1.0 / dot(x, a);
  return {scale * Vec3(a.x(), b.x(), c.x()), scale * Vec3(a.y(), b.y(), c.y()),
          scale * Vec3(a.z(), b.z(), c.z())};
}

}  // namespace

double paperInertia(const Link& link, PaperForm form) {
  return form.mass ? link.mass : 0.5 * (link.inertia.xx + link.inertia.yy);
}

void PaperBody::gather(const std::vector<Link>& links, const ChainState& state,
                       const Kinematics& kinematics, const Loads& loads,
                       const Implicitness& implicitness) {
  const std::size_t n = links.size();
  net_.resize(n);
  turn_.resize(n);
  nodes_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Link& link = links[i];
    Node& node = nodes_[i];
    node.first = axisX(kinematics.pose[i].orientation);
    node.second = axisY(kinematics.pose[i].orientation);
    node.k = implicitness.stiffness * link.stiffness + implicitness.damping * link.damping;
    const double j = paperInertia(link, form_);
    node.inertia = {Vec3(j, 0.0, 0.0), Vec3(0.0, j, 0.0), Vec3(0.0, 0.0, j)};
    node.predicted = Vec3::Zero();
    const Vec2 &q = state.q[i], &rate = state.rate[i], &extra = loads.joint_torque[i];
    const Vec3 t1 = (extra.x() - link.stiffness * q.x() - link.damping * rate.x()) * node.first;
    const Vec3 t2 = (extra.y() - link.stiffness * q.y() - link.damping * rate.y()) * node.second;
    net_[i] = loads.wrench[i].torque + t1 + t2;
    if (link.parent < 0) continue;
    Vec3& parent = net_[static_cast<std::size_t>(link.parent)];
    parent -= t1;
    parent -= (form_.reaction ? -1.0 : 1.0) * t2;
  }
  for (const Anchor& anchor : loads.anchors) {
    const auto i = static_cast<std::size_t>(anchor.link);
    net_[i] += cross(anchor.arm, anchor.force);
    Symmetric3 mass;
    add(mass, implicitness.stiffness, anchor.stiffness);
    add(mass, implicitness.damping, anchor.damping);
    const Symmetric3 about = aboutJoint(mass, anchor.arm);
    nodes_[i].inertia.x += Vec3(about.xx, about.xy, about.xz);
    nodes_[i].inertia.y += Vec3(about.xy, about.yy, about.yz);
    nodes_[i].inertia.z += Vec3(about.xz, about.yz, about.zz);
  }
}

// Computes the acceleration of the joint as an affine function of the parent's turn.
void PaperBody::solve(Node& node, const Vec3& torque) const {
  const Matrix& n = node.inertia;
  double m11, m12, m21, m22, r1, r2;
  Vec3 p1 = node.first, p2 = node.second;
  if (form_.parent) {
    const Rows w = inverse(n.x, n.y, n.z);
    const auto times = [&w](const Vec3& v) { return Vec3(dot(w.x, v), dot(w.y, v), dot(w.z, v)); };
    node.free = times(torque);
    node.by1 = times(node.first);
    node.by2 = times(node.second);
    m11 = 1.0 + node.k * dot(node.first, node.by1);
    m12 = node.k * dot(node.first, node.by2);
    m21 = node.k * dot(node.second, node.by1);
    m22 = 1.0 + node.k * dot(node.second, node.by2);
    r1 = dot(node.first, node.free);
    r2 = dot(node.second, node.free);
  } else {
    p1 = node.first.x() * n.x + node.first.y() * n.y + node.first.z() * n.z;
    p2 = node.second.x() * n.x + node.second.y() * n.y + node.second.z() * n.z;
    m11 = dot(p1, node.first) + node.k;
    m12 = dot(p1, node.second);
    m21 = dot(p2, node.first);
    m22 = dot(p2, node.second) + node.k;
    r1 = dot(node.first, torque);
    r2 = dot(node.second, torque);
  }
  const double scale = 1.0 / (m11 * m22 - m12 * m21);
  node.g1 = scale * (m22 * r1 - m12 * r2);
  node.g2 = scale * (m11 * r2 - m21 * r1);
  node.row1 = scale * (m22 * p1 - m12 * p2);
  node.row2 = scale * (m11 * p2 - m21 * p1);
}

// Adds the effect of a joint's implicit torque on the parent, as a function of the parent's turn.
void PaperBody::passOn(const Node& node, Node& parent) const {
  const Vec3 first = node.k * node.first;
  const Vec3 second = (form_.reaction ? -node.k : node.k) * node.second;
  parent.predicted += node.g1 * first + node.g2 * second;
  parent.inertia.x += first.x() * node.row1 + second.x() * node.row2;
  parent.inertia.y += first.y() * node.row1 + second.y() * node.row2;
  parent.inertia.z += first.z() * node.row1 + second.z() * node.row2;
}

void PaperBody::accelerations(const std::vector<Link>& links, const std::vector<BaseMotion>& bases,
                              const ChainState& state, const Kinematics& kinematics,
                              const Loads& loads, const Implicitness& implicitness,
                              std::vector<Vec2>& out) {
  gather(links, state, kinematics, loads, implicitness);
  for (std::size_t i = links.size(); i-- > 0;) {
    solve(nodes_[i], net_[i] + nodes_[i].predicted);
    if (links[i].parent >= 0) passOn(nodes_[i], nodes_[static_cast<std::size_t>(links[i].parent)]);
  }
  out.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Node& node = nodes_[i];
    Vec3 parent = Vec3::Zero();
    if (links[i].parent >= 0) {
      parent = turn_[static_cast<std::size_t>(links[i].parent)];
    } else if (!bases.empty()) {
      parent = bases[static_cast<std::size_t>(links[i].base)].spin_rate;
    }
    out[i] = Vec2(node.g1 - dot(node.row1, parent), node.g2 - dot(node.row2, parent));
    turn_[i] = form_.parent
                   ? Vec3(node.free - node.k * (out[i].x() * node.by1 + out[i].y() * node.by2))
                   : Vec3(parent + out[i].x() * node.first + out[i].y() * node.second);
  }
}

}  // namespace vegetation_sim::physics
