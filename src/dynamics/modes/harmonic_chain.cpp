// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/modes/harmonic_chain.h"

#include "dynamics/chain/articulated.h"
#include "dynamics/chain/symmetric.h"

namespace vegetation_sim::physics {
namespace {

using Complex = HarmonicChain::Complex;
using Column = HarmonicChain::Column;
using Block = std::array<Column, 6>;

Complex operator+(const Complex& a, const Complex& b) {
  return {a.re + b.re, a.im + b.im};
}
Complex operator-(const Complex& a, const Complex& b) {
  return {a.re - b.re, a.im - b.im};
}
Complex operator*(const Complex& a, const Complex& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex operator*(double a, const Complex& b) {
  return {a * b.re, a * b.im};
}
Complex inverse(const Complex& a) {
  const double size = a.re * a.re + a.im * a.im;
  return {a.re / size, -a.im / size};
}

// Adds a x b of a real vector and three components of a column.
void addCross(const Vec3& a, const Column& b, std::size_t from, Column& out, std::size_t to) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
    const auto at = [&](std::size_t i) { return a[static_cast<Eigen::Index>(i)]; };
    out[to + k] = out[to + k] + at(p) * b[from + q] - at(q) * b[from + p];
  }
}

// Columns are force and torque about the joint per unit of displacement and turn, for a body with
// `mass`, with the moment of its centre, and with `inertia`.
Block rigid(double mass, const Vec3& moment, const Symmetric3& inertia) {
  Block out{};
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 unit = Vec3::Zero();
    unit[static_cast<Eigen::Index>(k)] = 1.0;
    const Vec3 twist = cross(moment, unit), pull = cross(unit, moment),
               turn = multiply(inertia, unit);
    out[k][k].re = mass;
    for (std::size_t j = 0; j < 3; ++j) {
      out[k][3 + j].re = twist[static_cast<Eigen::Index>(j)];
      out[3 + k][j].re = pull[static_cast<Eigen::Index>(j)];
      out[3 + k][3 + j].re = turn[static_cast<Eigen::Index>(j)];
    }
  }
  return out;
}

// Returns the impedance of a point that is held back by `drag` at `arm`.
Block gripped(double drag, const Vec3& arm) {
  const double s = dot(arm, arm);
  const auto part = [&](int i, int j) { return drag * ((i == j ? s : 0.0) - arm[i] * arm[j]); };
  return rigid(drag, drag * arm,
               {part(0, 0), part(1, 1), part(2, 2), part(0, 1), part(0, 2), part(1, 2)});
}

// Projects a force and torque on turns about an axis.
Complex along(const Vec3& axis, const Column& column) {
  return axis.x() * column[3] + axis.y() * column[4] + axis.z() * column[5];
}

// Moves a wrench from a joint to the parent's joint.
Column carried(Column wrench, const Vec3& offset) {
  addCross(offset, wrench, 0, wrench, 3);
  return wrench;
}

// Does the same for all columns and, since the block is symmetric, for all rows.
Block carried(const Block& block, const Vec3& offset) {
  Block half{}, out{};
  for (std::size_t k = 0; k < 6; ++k) half[k] = carried(block[k], offset);
  for (std::size_t k = 0; k < 6; ++k) {
    Column row;
    for (std::size_t j = 0; j < 6; ++j) row[j] = half[j][k];
    row = carried(row, offset);
    for (std::size_t j = 0; j < 6; ++j) out[j][k] = row[j];
  }
  return out;
}

}  // namespace

HarmonicChain::HarmonicChain(const std::vector<Link>& links, const std::vector<Grip>& grips)
    : nodes_(links.size()), impedance_(links.size()), load_(links.size()), motion_(links.size()) {
  const std::vector<Pose> rest = LinearChain(links).rest();
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    const Quat& q = rest[i].orientation;
    Node& node = nodes_[i];
    node.parent = link.parent;
    node.axes = {axisX(q), axisY(q)};
    node.offset = rest[i].position;
    if (link.parent >= 0) node.offset -= rest[static_cast<std::size_t>(link.parent)].position;
    node.mass = rigid(link.mass, link.mass * rotate(q, link.centre),
                      turned(link.inertia, node.axes[0], node.axes[1], axisZ(q)));
    node.air = gripped(grips[i].steady, rotate(q, grips[i].centre));
    node.stiffness = link.stiffness;
    node.damping = link.damping;
  }
}

void HarmonicChain::setFrequency(double w) {
  w_ = w;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t j = 0; j < 6; ++j)
        impedance_[i][k][j] = {-w * w * nodes_[i].mass[k][j].re, w * nodes_[i].air[k][j].re};
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    reduce(node, impedance_[i]);
    if (node.parent < 0) continue;
    const Block seen = carried(impedance_[i], node.offset);
    Block& bearer = impedance_[static_cast<std::size_t>(node.parent)];
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t j = 0; j < 6; ++j) bearer[k][j] = bearer[k][j] + seen[k][j];
  }
}

// Eliminates the joint from the impedance.
void HarmonicChain::reduce(Node& node, Block& impedance) const {
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t j = 0; j < 6; ++j)
      node.lever[a][j] = node.axes[a].x() * impedance[3][j] + node.axes[a].y() * impedance[4][j] +
                         node.axes[a].z() * impedance[5][j];
  const Complex own{node.stiffness, w_ * node.damping};
  const Complex p = along(node.axes[0], node.lever[0]) + own,
                q = along(node.axes[1], node.lever[1]) + own,
                r = along(node.axes[0], node.lever[1]);
  const Complex scale = inverse(p * q - r * r);
  node.give = {{{q * scale, Complex{} - r * scale}, {Complex{} - r * scale, p * scale}}};
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t k = 0; k < 6; ++k) {
        const Complex part = node.give[a][b] * node.lever[b][k];
        for (std::size_t j = 0; j < 6; ++j)
          impedance[k][j] = impedance[k][j] - node.lever[a][j] * part;
      }
}

// A load C cos w t + S sin w t is the real part of (C - i S) exp(i w t).
void HarmonicChain::solve(std::vector<double>& cosine, std::vector<double>& sine) {
  load_.assign(nodes_.size(), Column{});
  std::vector<std::array<Complex, 2>> torque(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& node = nodes_[i];
    Column& load = load_[i];
    for (std::size_t a = 0; a < 2; ++a)
      torque[i][a] = Complex{cosine[2 * i + a], -sine[2 * i + a]} + along(node.axes[a], load);
    if (node.parent < 0) continue;
    for (std::size_t a = 0; a < 2; ++a) {
      const Complex bend = node.give[a][0] * torque[i][0] + node.give[a][1] * torque[i][1];
      for (std::size_t j = 0; j < 6; ++j) load[j] = load[j] - bend * node.lever[a][j];
    }
    const Column seen = carried(load, node.offset);
    Column& bearer = load_[static_cast<std::size_t>(node.parent)];
    for (std::size_t j = 0; j < 6; ++j) bearer[j] = bearer[j] + seen[j];
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    Column motion{};
    if (node.parent >= 0) {
      motion = motion_[static_cast<std::size_t>(node.parent)];
      addCross(-node.offset, motion, 3, motion, 0);  // turn x offset
    }
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t j = 0; j < 6; ++j)
        torque[i][a] = torque[i][a] - node.lever[a][j] * motion[j];
    for (std::size_t a = 0; a < 2; ++a) {
      const Complex bend = node.give[a][0] * torque[i][0] + node.give[a][1] * torque[i][1];
      cosine[2 * i + a] = bend.re;
      sine[2 * i + a] = -bend.im;
      for (std::size_t k = 0; k < 3; ++k)
        motion[3 + k] = motion[3 + k] + node.axes[a][static_cast<Eigen::Index>(k)] * bend;
    }
    motion_[i] = motion;
  }
}

}  // namespace vegetation_sim::physics
