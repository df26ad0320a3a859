// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "trees/engine.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::bench {
namespace {

// Extended position-based dynamics of rigid bodies (Mueller et al. 2020), one pass over the joints
// per step, from the root to the tips. A joint holds the foot of a branch at its place and its
// twist at zero; its bend is a spring with the compliance 1 / stiffness and a damper.
class PositionEngine final : public Engine {
 public:
  PositionEngine(const TestTree& tree, const TestLoad& load)
      : tree_(tree), load_(load), tips_(tree.tips()) {
    bodies_.resize(tree.links.size());
    rest();
    start_ = bodies_;
  }

  void rest() override {
    if (!start_.empty()) {
      bodies_ = start_;
      return;
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const TestLink& link = tree_.links[i];
      Body& body = bodies_[i];
      const double centre = 0.5 * link.length, across = link.across - link.mass * centre * centre;
      body.lightness = 1.0 / link.mass;
      body.inertia = {across, across, link.along};
      body.turn = parentTurn(link) * toEigen(link.rest);
      body.turn.normalize();
      body.place = foot(link) + body.turn * Vec3(0.0, 0.0, centre);
    }
  }

  void step(int interval, double time, double h) override {
    predict(load_.factor(interval, time + 0.5 * h), h);
    for (std::size_t i = 0; i < bodies_.size(); ++i) bend(i, h);
    for (std::size_t i = 0; i < bodies_.size(); ++i) attach(i);
    for (Body& body : bodies_) {
      body.velocity = (body.place - body.old_place) / h;
      Eigen::Quaterniond change = body.turn * body.old_turn.conjugate();
      if (change.w() < 0.0) change.coeffs() *= -1.0;
      body.spin = 2.0 / h * change.vec();
    }
  }

  std::vector<Vec3> tips() const override {
    std::vector<Vec3> out;
    for (const int tip : tips_) {
      const Body& body = bodies_[static_cast<std::size_t>(tip)];
      const double half = 0.5 * tree_.links[static_cast<std::size_t>(tip)].length;
      out.push_back(body.place + body.turn * Vec3(0.0, 0.0, half));
    }
    return out;
  }

 private:
  struct Body {
    double lightness{0.0};       // inverse mass
    Vec3 inertia{Vec3::Zero()};  // about the centre, along the body's axes
    Vec3 place{Vec3::Zero()}, old_place{Vec3::Zero()}, velocity{Vec3::Zero()}, spin{Vec3::Zero()};
    Eigen::Quaterniond turn{Eigen::Quaterniond::Identity()}, old_turn{turn};

    Vec3 answer(const Vec3& torque) const {
      return turn * (turn.conjugate() * torque).cwiseQuotient(inertia);
    }
    void rotate(const Vec3& by) {
      const Eigen::Quaterniond change(0.0, by.x(), by.y(), by.z());
      turn.coeffs() += 0.5 * (change * turn).coeffs();
      turn.normalize();
    }
  };

  static Eigen::Quaterniond toEigen(const Quat& q) { return {q.w, q.x, q.y, q.z}; }
  Eigen::Quaterniond parentTurn(const TestLink& link) const {
    return link.parent < 0 ? Eigen::Quaterniond::Identity()
                           : bodies_[static_cast<std::size_t>(link.parent)].turn;
  }
  // Returns where the parent, or the ground, holds the foot of a branch.
  Vec3 foot(const TestLink& link) const {
    if (link.parent < 0) return {0.0, 0.0, link.h};
    const auto parent = static_cast<std::size_t>(link.parent);
    const Body& body = bodies_[parent];
    return body.place + body.turn * Vec3(0.0, 0.0, link.h - 0.5 * tree_.links[parent].length);
  }

  void predict(double factor, double h) {
    for (Body& body : bodies_) body.old_place = body.place, body.old_turn = body.turn;
    for (std::size_t i = 0; factor != 0.0 && i < load_.links.size(); ++i) {
      const auto link = static_cast<std::size_t>(load_.links[i]);
      Body& body = bodies_[link];
      const Vec3 force = factor * load_.force[i];
      const Vec3 arm = body.turn * Vec3(0.0, 0.0, load_.along[i] - 0.5 * tree_.links[link].length);
      body.velocity += h * body.lightness * force;
      body.spin += h * body.answer(arm.cross(force));
    }
    for (Body& body : bodies_) {
      const Vec3 momentum =
          body.turn * body.inertia.cwiseProduct(body.turn.conjugate() * body.spin);
      body.spin -= h * body.answer(body.spin.cross(momentum));
      body.place += h * body.velocity;
      body.rotate(h * body.spin);
    }
  }

  // Applies spring and damper of the bend, and holds the twist.
  void bend(std::size_t index, double h) {
    const TestLink& link = tree_.links[index];
    Body& body = bodies_[index];
    Body* parent = link.parent < 0 ? nullptr : &bodies_[static_cast<std::size_t>(link.parent)];
    const Eigen::Quaterniond base = parentTurn(link) * toEigen(link.rest);
    const Vec3 off = base * turnOf(base.conjugate() * body.turn);
    const Vec3 moved =
        turnOf(body.turn * body.old_turn.conjugate()) -
        (parent ? turnOf(parent->turn * parent->old_turn.conjugate()) : Vec3(Vec3::Zero()));
    const Vec3 along = base * Vec3::UnitZ();
    const double twist = off.dot(along);
    turnBoth(body, parent, along, -twist, 0.0, 1.0);
    const Vec3 arc = off - twist * along;
    const double size = arc.norm();
    if (size < 1e-12) return;
    const Vec3 axis = arc / size;
    const double compliance = 1.0 / (h * h * link.stiffness),
                 damping = link.damping / (h * link.stiffness);
    turnBoth(body, parent, axis, -size - damping * moved.dot(axis), compliance, 1.0 + damping);
  }

  static Vec3 turnOf(Eigen::Quaterniond q) {
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    const double size = q.vec().norm();
    return size < 1e-12 ? Vec3(2.0 * q.vec())
                        : Vec3(2.0 * std::atan2(size, q.w()) / size * q.vec());
  }

  static void turnBoth(Body& body, Body* parent, const Vec3& axis, double error, double compliance,
                       double damped) {
    const Vec3 own = body.answer(axis), other = parent ? parent->answer(axis) : Vec3(Vec3::Zero());
    const double multiplier = error / (damped * axis.dot(own + other) + compliance);
    body.rotate(multiplier * own);
    if (parent) parent->rotate(-multiplier * other);
  }

  // Moves the foot of a branch to where its parent holds it.
  void attach(std::size_t index) {
    const TestLink& link = tree_.links[index];
    Body& body = bodies_[index];
    Body* parent = link.parent < 0 ? nullptr : &bodies_[static_cast<std::size_t>(link.parent)];
    const Vec3 arm = body.turn * Vec3(0.0, 0.0, -0.5 * link.length), held = foot(link);
    const Vec3 gap = held - (body.place + arm);
    const double size = gap.norm();
    if (size < 1e-15) return;
    const Vec3 way = gap / size, lever = arm.cross(way);
    double weight = body.lightness + lever.dot(body.answer(lever));
    Vec3 other = Vec3::Zero();
    if (parent) {
      other = (held - parent->place).cross(way);
      weight += parent->lightness + other.dot(parent->answer(other));
    }
    const double impulse = size / weight;
    body.place += impulse * body.lightness * way;
    body.rotate(impulse * body.answer(lever));
    if (!parent) return;
    parent->place -= impulse * parent->lightness * way;
    parent->rotate(-impulse * parent->answer(other));
  }

  const TestTree& tree_;
  const TestLoad& load_;
  std::vector<int> tips_;
  std::vector<Body> bodies_, start_;
};

}  // namespace

std::vector<Maker> positionEngines() {
  Maker out;
  out.name = "position-based";
  out.peer = true;
  out.make = [](const TestTree& tree, const TestLoad& load,
                const std::string&) -> std::unique_ptr<Engine> {
    return std::make_unique<PositionEngine>(tree, load);
  };
  return {out};
}

}  // namespace vegetation_sim::bench
