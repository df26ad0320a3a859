// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <SimTKsimbody.h>

#include <array>
#include <cmath>
#include <exception>
#include <limits>

#include "trees/engine.h"

namespace vegetation_sim::bench {
namespace {

// The engine's recursion of order N through its operator for accelerations, without the cost of its
// integrators; the rates of these joints are those of their angles.
class SimbodyEngine : public Engine {
 public:
  SimbodyEngine(const TestTree& tree, const TestLoad& load)
      : tree_(tree), load_(load), matter_(system_) {
    for (std::size_t i = 0; i < tree.links.size(); ++i) add(i);
    start_ = system_.realizeTopology();
    state_ = start_;
    joint_forces_.resize(state_.getNU());
    body_forces_.resize(matter_.getNumBodies());
  }

  void rest() override { state_ = start_, broken_ = false; }

  // The engine throws once a state is not finite. Steps after that begin at rest, so that they
  // take their time.
  void step(int interval, double time, double h) override {
    constexpr double FARTHEST = 100.0;  // beyond any motion that is compared [rad]
    bool wild = false;
    for (int i = 0; i < state_.getNQ(); ++i) wild |= !(std::fabs(state_.getQ()[i]) < FARTHEST);
    broken_ |= wild;
    if (wild) state_ = start_;
    try {
      take(interval, time, h);
    } catch (const std::exception&) {
      broken_ = true;
      state_ = start_;
    }
  }

  std::vector<Vec3> tips() const override {
    constexpr double NO_NUMBER = std::numeric_limits<double>::quiet_NaN();
    if (broken_) return {tree_.tips().size(), Vec3::Constant(NO_NUMBER)};
    std::vector<double> q;
    for (const SimTK::MobilizedBody& body : bodies_)
      for (const int k : {0, 1}) q.push_back(body.getOneQ(state_, k));
    return tipsOf(tree_, Bend::HINGES, q);
  }

 protected:
  virtual void take(int interval, double time, double h) = 0;
  // Returns the accelerations of the state under the load.
  const SimTK::Vector& evaluate(double factor) {
    system_.realize(state_, SimTK::Stage::Dynamics);
    body_forces_.setToZero();
    for (std::size_t i = 0; factor != 0.0 && i < load_.links.size(); ++i) {
      const SimTK::MobilizedBody& body = bodies_[static_cast<std::size_t>(load_.links[i])];
      const Vec3 force = factor * load_.force[i];
      body.applyForceToBodyPoint(state_, SimTK::Vec3(0, 0, load_.along[i]),
                                 SimTK::Vec3(force.x(), force.y(), force.z()), body_forces_);
    }
    const SimTK::Vector &q = state_.getQ(), &rate = state_.getU();
    for (int i = 0; i < q.size(); ++i) {
      const TestLink& link = tree_.links[static_cast<std::size_t>(i / 2)];
      joint_forces_[i] = -link.stiffness * q[i] - link.damping * rate[i];
    }
    matter_.calcAcceleration(state_, joint_forces_, body_forces_, acceleration_, motions_);
    return acceleration_;
  }
  double factor(int interval, double time) const { return load_.factor(interval, time); }

  SimTK::State state_;

 private:
  void add(std::size_t index) {
    const TestLink& link = tree_.links[index];
    const SimTK::Quaternion rest(link.rest.w, link.rest.x, link.rest.y, link.rest.z);
    const SimTK::Transform joint(SimTK::Rotation(rest), SimTK::Vec3(0, 0, link.h));
    const SimTK::Body::Rigid body(
        SimTK::MassProperties(link.mass, SimTK::Vec3(0, 0, 0.5 * link.length),
                              SimTK::Inertia(link.across, link.across, link.along)));
    SimTK::MobilizedBody& parent = link.parent < 0
                                       ? static_cast<SimTK::MobilizedBody&>(matter_.updGround())
                                       : bodies_[static_cast<std::size_t>(link.parent)];
    bodies_.push_back(SimTK::MobilizedBody::Universal(parent, joint, body, SimTK::Transform()));
  }

  const TestTree& tree_;
  const TestLoad& load_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::Array_<SimTK::MobilizedBody> bodies_;
  SimTK::State start_;
  bool broken_{false};
  SimTK::Vector joint_forces_, acceleration_;
  SimTK::Vector_<SimTK::SpatialVec> body_forces_, motions_;
};

class EulerSimbody final : public SimbodyEngine {
 public:
  using SimbodyEngine::SimbodyEngine;
  void take(int interval, double time, double h) override {
    state_.updU() += h * evaluate(factor(interval, time + 0.5 * h));
    state_.updQ() += h * state_.getU();
  }
};

class RungeKuttaSimbody final : public SimbodyEngine {
 public:
  using SimbodyEngine::SimbodyEngine;
  void take(int interval, double time, double h) override {
    constexpr std::array<double, 4> AHEAD{0.0, 0.5, 0.5, 1.0}, WEIGHT{1.0, 2.0, 2.0, 1.0};
    const SimTK::Vector q = state_.getQ(), rate = state_.getU();
    SimTK::Vector turn(q.size(), 0.0), change(q.size(), 0.0);
    for (std::size_t stage = 0; stage < AHEAD.size(); ++stage) {
      if (stage > 0) {
        const SimTK::Vector slope = state_.getU();
        state_.updQ() = q + AHEAD[stage] * h * slope;
        state_.updU() = rate + AHEAD[stage] * h * slope_;
      }
      const SimTK::Vector now = state_.getU();
      slope_ = evaluate(factor(interval, time + AHEAD[stage] * h));
      turn += h / 6.0 * WEIGHT[stage] * now;
      change += h / 6.0 * WEIGHT[stage] * slope_;
    }
    state_.updQ() = q + turn;
    state_.updU() = rate + change;
  }

 private:
  SimTK::Vector slope_;
};

template <class ENGINE>
Maker maker(const char* name) {
  Maker out;
  out.name = name;
  out.peer = true;
  out.bend = Bend::HINGES;
  out.make = [](const TestTree& tree, const TestLoad& load,
                const std::string&) -> std::unique_ptr<Engine> {
    return std::make_unique<ENGINE>(tree, load);
  };
  return out;
}

}  // namespace

std::vector<Maker> simbodyEngines() {
  return {maker<EulerSimbody>("Simbody, Euler"), maker<RungeKuttaSimbody>("Simbody, RK4")};
}

}  // namespace vegetation_sim::bench
