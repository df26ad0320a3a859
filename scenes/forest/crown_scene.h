// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "dynamics/contact/contact_stepper.h"
#include "dynamics/integration/integrator.h"
#include "forest/contact/contact_body.h"
#include "forest/contact/contact_finder.h"
#include "forest/contact/substep_bisection.h"
#include "scenes/forest/forest_fixture.h"
#include "tree/growth/branch_mass.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {

/// Returns a whole tree as physical links, one per branch.
inline std::vector<physics::Link> linksOf(const Skeleton& skeleton, const Wood& wood) {
  std::vector<physics::Link> out(skeleton.branches.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Branch& b = skeleton.branches[i];
    const Composite& own = wood.own[i];
    const auto& inertia = own.inertia;
    out[i].parent = b.parent;
    out[i].h = b.h;
    out[i].rest = restRotation(b.theta, b.phi);
    out[i].length = b.length;
    out[i].mass = own.mass;
    out[i].centre = own.moment / own.mass;
    out[i].inertia = {inertia[0], inertia[1], inertia[2], inertia[3], inertia[4], inertia[5]};
    out[i].stiffness = wood.stiffness[i];
    out[i].damping = wood.damping[i];
  }
  return out;
}

/// Result of a drive through a crown.
struct CrownResult {
  double deepest_thin{0.0};   ///< overlap of wood thinner than 1 cm in radius [m]
  double deepest_own{0.0};    ///< the same, of surface that is not inside the parent [m]
  double deepest_thick{0.0};  ///< of other wood [m]
  double hardest{0.0};        ///< force of one contact [N]
  double steepest_rise{0.0};  ///< of the force of one contact between substeps [N/s]
  double largest_rise{0.0};   ///< of the force on one branch between substeps [N]
  double largest_fall{0.0};   ///< largest fall of it [N]
  double largest_jump{0.0};   ///< of the body's total force between steps [N]
  double largest_force{0.0};  ///< of the body's total force [N]
  int touched{0};             ///< branches with a force
  int parts{0};               ///< of steps
  int limited{0};             ///< substeps of contacts at the limit
  int disagreed{0};           ///< substeps whose contact forces did not converge
  double trials{0.0};         ///< per step in contact
  double left_over{0.0};      ///< largest displacement of a tip after the rest [m]
};

constexpr double THIN = 0.01;  ///< radius [m]

/// How steps near a body are divided; the default is that of a forest.
struct SubstepRule {
  bool by_travel{true};  ///< ContactFinder::countSubsteps
  bool by_force{true};   ///< SubstepBisection
};

/// A capsule of given radius, crosswise and level, driven through the crown of one tree that is
/// physical as a whole.
class CrownScene {
 public:
  CrownScene(const std::string& species, std::uint64_t seed) {
    layout_.species = {shippedSpecies(species)};
    TreeSeed tree;
    tree.seed = seed;
    layout_.trees = {tree};
    tree_ = growTree(layout_, 0, terrain::HeightMap());
    wood_ = woodOf(tree_.skeleton, layout_.species[0], Material::BEAM);
    links_ = linksOf(tree_.skeleton, wood_);
    state_ = {std::vector<physics::Vec2>(links_.size(), physics::Vec2::Zero()),
              std::vector<physics::Vec2>(links_.size(), physics::Vec2::Zero())};
    for (std::size_t i = 0; i < links_.size(); ++i) branches_.push_back(static_cast<int>(i));
    physics::kinematicsOf(links_, {}, state_, kinematics_);
    body_.id = "arm";
    body_.shape = Shape::CAPSULE;
  }

  const Skeleton& skeleton() const { return tree_.skeleton; }
  const physics::Kinematics& kinematics() const { return kinematics_; }
  physics::ContactLaw law;
  SubstepRule rule;
  bool observes{true};  ///< without it a drive has no results, as for a measurement of its time

  /// Drives the capsule from `from` along x for `way` metres, then removes it.
  CrownResult drive(const Vec3& from, double radius, double length, double speed, double way) {
    body_.size = Vec3(radius, 0.0, length);
    body_.pose = {from, Quat{std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0}};  // its z along -y
    body_.velocity = Vec3(speed, 0.0, 0.0);
    CrownResult out;
    const int steps = static_cast<int>(way / speed * PHYSICS_RATE);
    for (int i = 0; i < steps; ++i) step({{body_.id, body_}}, observes ? &out : nullptr);
    out.touched = static_cast<int>(touched_.size());
    out.trials = contact_steps_ ? out.trials / contact_steps_ : 0.0;
    return out;
  }
  /// Waits without the body; returns the largest displacement of a tip from rest [m].
  double leftOver(double seconds) {
    for (int i = 0; i < seconds * PHYSICS_RATE; ++i) step({}, nullptr);
    double out = 0.0;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Branch& b = tree_.skeleton.branches[i];
      out = std::max(out, length(tipOf(b, kinematics_.pose[i]) - tipOf(b, b.rest)));
    }
    return out;
  }

 private:
  Nanoseconds timeOf(std::int64_t tick) const { return TickGrid(PHYSICS_RATE).timeOf(tick); }

  ContactTree contactTree() const {
    return {0, Vec3::Zero(), branches_, tree_.skeleton, kinematics_};
  }
  void step(const Bodies& bodies, CrownResult* result) {
    const Nanoseconds from = timeOf(tick_), to = timeOf(++tick_);
    const int parts = rule.by_travel ? finder_.countSubsteps(contactTree(), bodies, from, to) : 1;
    bisection_ = SubstepBisection();
    for (int k = 0; k < parts; ++k)
      stepPart(bodies, from + (to - from) * k / parts, from + (to - from) * (k + 1) / parts,
               result);
  }
  void stepPart(const Bodies& bodies, Nanoseconds from, Nanoseconds to, CrownResult* result) {
    const double h = secondsBetween(from, to);
    const PersistentContacts persistent = persistent_;
    const physics::ChainState state = state_;
    const double theta = theta_;
    std::vector<physics::Contact> contacts =
        finder_.findContacts(contactTree(), bodies, from, to, persistent_);
    theta_ = physics::guardedTheta(state_, h, theta_);
    stepper_.step(links_, {}, law, 0.0, h, theta_, state_, contacts);
    if (rule.by_force && bisection_.bisect(stepper_, law, to - from)) {
      const Nanoseconds middle = from + (to - from) / 2;
      persistent_ = persistent, state_ = state, theta_ = theta;
      stepPart(bodies, from, middle, result);
      return stepPart(bodies, middle, to, result);
    }
    const physics::Kinematics before = kinematics_;
    std::vector<Reaction> reactions;
    finder_.recordForces(contactTree(), bodies, contacts, to, persistent_, reactions);
    physics::kinematicsOf(links_, {}, state_, kinematics_);
    if (!result) return;
    ++result->parts;
    note(contacts, h, *result);
    for (std::size_t i = 0; i < links_.size(); ++i) look(i, before, from, to, *result);
  }

  void note(const std::vector<physics::Contact>& contacts, double h, CrownResult& result) {
    Vec3 force = Vec3::Zero();
    for (const physics::Contact& contact : contacts) {
      force -= contact.force * contact.normal;
      result.hardest = std::max(result.hardest, contact.force);
      result.limited += contact.limited;
      double& last = force_of_[contact.link];
      result.steepest_rise = std::max(result.steepest_rise, (contact.force - last) / h);
      if (contact.force > 0.0) touched_[contact.link] = 1;
    }
    std::map<int, double> forces, sums;
    for (const physics::Contact& contact : contacts) {
      forces[contact.link] = contact.force;
      sums[contact.link] += contact.force;
    }
    for (const auto& [link, sum] : sums)
      result.largest_rise = std::max(result.largest_rise, sum - sum_of_[link]);
    for (const auto& [link, last] : sum_of_)
      result.largest_fall = std::max(result.largest_fall, last - sums[link]);
    sum_of_ = sums;
    force_of_ = forces;
    result.disagreed += !stepper_.agreed();
    if (!contacts.empty()) {
      result.trials += stepper_.trials();
      ++contact_steps_;
    }
    result.largest_jump = std::max(result.largest_jump, length(force - last_force_));
    result.largest_force = std::max(result.largest_force, length(force));
    last_force_ = force;
  }

  /// Measures the overlap between two states, sampled on straight paths, independently of the
  /// finder.
  void look(std::size_t i, const physics::Kinematics& before, Nanoseconds from, Nanoseconds to,
            CrownResult& result) {
    const Branch& b = tree_.skeleton.branches[i];
    const double room = shapeOf(body_).reach() + b.length + 0.5;
    if (length(kinematics_.pose[i].position - poseAt(body_, to).position) > room) return;
    for (int n = 1; n <= 8; ++n) {
      const double part = n / 8.0;
      const Pose at = poseAt(body_, from + static_cast<Nanoseconds>(part * double(to - from)));
      const Bar bar = barAt(i, before, part, at);
      const physics::Proximity found = physics::nearest(shapeOf(body_), bar);
      if (found.gap >= 0.0) continue;
      const bool thin = bar.radiusAt(found.along) < THIN;
      double& deepest = thin ? result.deepest_thin : result.deepest_thick;
      deepest = std::max(deepest, -found.gap);
      if (!thin) continue;
      const bool joined = overlaps(b.parent, before, part, at);
      const double own = joined ? ownDepth(i, before, part, at) : -found.gap;
      result.deepest_own = std::max(result.deepest_own, own);
    }
  }

  using Bar = physics::Bar;
  /// Returns a branch at a fraction of a step in the body's axes, from its joint or, if `out`, from
  /// where it emerges from its parent.
  Bar barAt(std::size_t i, const physics::Kinematics& before, double part, const Pose& at,
            bool out = true) const {
    const Branch& b = tree_.skeleton.branches[i];
    const Pose &p0 = before.pose[i], &p1 = kinematics_.pose[i];
    const double start =
        out ? findExposedStart(tree_.skeleton, static_cast<int>(i)) / b.length : 0.0;
    const Vec3 joint = (1.0 - part) * p0.position + part * p1.position;
    const Vec3 tip = (1.0 - part) * tipOf(b, p0) + part * tipOf(b, p1);
    const Vec3 base = joint + start * (tip - joint);
    const Quat turn = conjugate(at.orientation);
    return {rotate(turn, Vec3(base - at.position)),
            rotate(turn, Vec3(tip - base)) / length(tip - base), length(tip - base),
            b.base_radius + start * (b.tip_radius - b.base_radius), b.tip_radius};
  }
  bool overlaps(int branch, const physics::Kinematics& before, double part, const Pose& at) const {
    if (branch < 0) return false;
    const Bar bar = barAt(static_cast<std::size_t>(branch), before, part, at, false);
    return physics::nearest(shapeOf(body_), bar).gap < 0.0;
  }
  /// Returns how deep the part of a twig's round surface that is outside its parent is inside the
  /// body. (The sphere at the end of its axis reaches back into the parent.)
  double ownDepth(std::size_t i, const physics::Kinematics& before, double part,
                  const Pose& at) const {
    const Bar twig = barAt(i, before, part, at, false);
    const auto parent = static_cast<std::size_t>(tree_.skeleton.branches[i].parent);
    const Bar bearer = barAt(parent, before, part, at, false);
    const Vec3 any = std::fabs(twig.axis.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 u = cross(twig.axis, any) / length(cross(twig.axis, any)), w = cross(twig.axis, u);
    Vec3 normal;
    double out = 0.0;
    const Vec3 tip = twig.at(twig.length);
    if (!inside(bearer, tip))
      out = twig.radiusAt(twig.length) - signedDistance(shapeOf(body_), tip, normal);
    const int rings = std::max(1, static_cast<int>(twig.length / 5e-4));
    for (int k = 0; k <= rings; ++k) {
      const double along = twig.length * k / rings, radius = twig.radiusAt(along);
      if (signedDistance(shapeOf(body_), twig.at(along), normal) > radius) continue;
      for (int spoke = 0; spoke < 48; ++spoke) {
        const SinCos turn = sinCosTurns(spoke / 48.0);
        const Vec3 point = twig.at(along) + radius * (turn.cos * u + turn.sin * w);
        if (inside(bearer, point)) continue;
        out = std::max(out, -signedDistance(shapeOf(body_), point, normal));
      }
    }
    return out;
  }
  static bool inside(const Bar& bar, const Vec3& point) {
    const double along = std::clamp(dot(point - bar.base, bar.axis), 0.0, bar.length);
    return length(point - bar.at(along)) < bar.radiusAt(along);
  }

  Layout layout_;
  Tree tree_;
  Wood wood_;
  std::vector<physics::Link> links_;
  std::vector<int> branches_;
  physics::ChainState state_;
  physics::Kinematics kinematics_;
  physics::ContactStepper stepper_;
  ContactFinder finder_;
  PersistentContacts persistent_;
  Body body_;
  double theta_{0.5};
  SubstepBisection bisection_;  // of this step
  std::int64_t tick_{0};
  Vec3 last_force_{Vec3::Zero()};
  std::map<int, int> touched_;
  std::map<int, double> force_of_, sum_of_;
  int contact_steps_{0};
};

}  // namespace vegetation_sim::forest
