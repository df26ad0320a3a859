// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/batch_step/batch_chain.h"
#include "dynamics/chain/inertia_bound.h"
#include "dynamics/integration/integrator.h"
#include "trees/engine.h"

namespace vegetation_sim::bench {
namespace {

using physics::Dynamics;
using physics::Integrator;
using physics::Products;

std::vector<physics::Link> linksOf(const TestTree& tree) {
  std::vector<physics::Link> out;
  for (const TestLink& from : tree.links) {
    physics::Link link;
    link.parent = from.parent;
    link.h = from.h;
    link.rest = from.rest;
    link.length = from.length;
    link.mass = from.mass;
    link.centre = Vec3(0.0, 0.0, 0.5 * from.length);
    link.inertia = {from.across, from.across, from.along, 0.0, 0.0, 0.0};
    link.stiffness = from.stiffness;
    link.damping = from.damping;
    out.push_back(link);
  }
  physics::shareInertia(out);
  return out;
}

physics::ChainState atRest(std::size_t links) {
  return {std::vector<physics::Vec2>(links, physics::Vec2::Zero()),
          std::vector<physics::Vec2>(links, physics::Vec2::Zero())};
}

// Common part of our engines: the load as a function of kinematics and time.
class OwnEngine : public Engine {
 public:
  OwnEngine(const TestTree& tree, const TestLoad& load) : tree_(tree), links_(linksOf(tree)) {
    outside_.loads = [this, &load](const physics::Kinematics& kinematics, double time,
                                   physics::Loads& loads) {
      const double factor = load.factor(interval_, time);
      if (factor == 0.0) return;
      for (std::size_t i = 0; i < load.links.size(); ++i) {
        const auto link = static_cast<std::size_t>(load.links[i]);
        const Vec3 force = factor * load.force[i];
        const Vec3 arm = load.along[i] * axisZ(kinematics.pose[link].orientation);
        loads.wrench[link] = {force, arm.cross(force)};
      }
    };
  }
  std::vector<Vec3> tips() const override {
    const physics::ChainState now = state();
    std::vector<double> q;
    for (const physics::Vec2& bend : now.q) q.insert(q.end(), {bend.x(), bend.y()});
    return tipsOf(tree_, Bend::SWING, q);
  }

 protected:
  virtual physics::ChainState state() const = 0;

  const TestTree& tree_;
  std::vector<physics::Link> links_;
  // Without load no kinematics are computed.
  const physics::Surroundings& around(int interval) {
    interval_ = interval;
    return interval < LOADED_INTERVALS ? outside_ : calm_;
  }

  physics::Surroundings outside_, calm_;
  int interval_{0};
};

// Takes each step in one part whatever the stability limit, to measure where a method becomes
// unstable.
template <Integrator INTEGRATOR, Dynamics DYNAMICS = Dynamics::ARTICULATED,
          Products PRODUCTS = Products::MEAN>
class PlainEngine : public OwnEngine {
 public:
  PlainEngine(const TestTree& tree, const TestLoad& load) : OwnEngine(tree, load) {
    stepper_.setDynamics(DYNAMICS);
    stepper_.setProducts(PRODUCTS);
  }
  void rest() override { state_ = atRest(links_.size()), theta_ = 0.5; }
  void step(int interval, double time, double h) override {
    stepper_.stepAsIs(INTEGRATOR, links_, around(interval), time, h, state_, theta_);
  }

 protected:
  physics::ChainState state() const override { return state_; }

 private:
  physics::ChainStepper stepper_;
  physics::ChainState state_;
  double theta_{0.5};
};

class BatchEngine : public OwnEngine {
 public:
  BatchEngine(const TestTree& tree, const TestLoad& load) : OwnEngine(tree, load), chain_(links_) {}
  void rest() override { chain_.setState(0, atRest(links_.size())); }
  void step(int interval, double time, double h) override {
    chain_.step(around(interval), time, h);
  }

 protected:
  physics::ChainState state() const override { return chain_.state(0); }

 private:
  physics::BatchChain chain_;
};

template <class ENGINE>
std::unique_ptr<Engine> make(const TestTree& tree, const TestLoad& load, const std::string&) {
  return std::make_unique<ENGINE>(tree, load);
}

template <class ENGINE>
Maker maker(const std::string& name, bool fast) {
  Maker out;
  out.name = name;
  out.fast = fast;
  out.make = make<ENGINE>;
  return out;
}

}  // namespace

std::vector<Maker> ownEngines() {
  return {
      maker<PlainEngine<Integrator::MIDPOINT>>("midpoint, plain double", true),
      maker<BatchEngine>("midpoint, SIMD, one tree", true),
      maker<PlainEngine<Integrator::MIDPOINT, Dynamics::ARTICULATED, Products::START>>(
          "midpoint, products at start", false),
      maker<PlainEngine<Integrator::IMPLICIT_EULER>>("implicit Euler", false),
      maker<PlainEngine<Integrator::SEMI_IMPLICIT_EULER>>("semi-implicit Euler", false),
      maker<PlainEngine<Integrator::EXPLICIT_EULER>>("explicit Euler", false),
      maker<PlainEngine<Integrator::RUNGE_KUTTA_4>>("Runge-Kutta 4", false),
      maker<PlainEngine<Integrator::MIDPOINT, Dynamics::PAPER>>("paper dynamics, midpoint", false)};
}

}  // namespace vegetation_sim::bench
