// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/UniversalJoint.hpp>

#include "trees/engine.h"

namespace vegetation_sim::bench {
namespace {

using dart::dynamics::BodyNode;
using dart::dynamics::UniversalJoint;

// Springs and dampers belong to the joint, whose forward dynamics takes them implicitly. Steps are
// those of the engine's world without collision and constraints.
class DartEngine : public Engine {
 public:
  DartEngine(const TestTree& tree, const TestLoad& load)
      : tree_(tree), load_(load), skeleton_(dart::dynamics::Skeleton::create("tree")) {
    skeleton_->setGravity(Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < tree.links.size(); ++i) add(i);
  }

  void rest() override { skeleton_->resetPositions(), skeleton_->resetVelocities(); }

  void step(int interval, double time, double h) override {
    if (skeleton_->getTimeStep() != h) skeleton_->setTimeStep(h);
    push(load_.factor(interval, time + 0.5 * h));
    skeleton_->computeForwardDynamics();
    skeleton_->integrateVelocities(h);
    skeleton_->integratePositions(h);
  }

  std::vector<Vec3> tips() const override {
    std::vector<double> q;
    for (const BodyNode* body : bodies_)
      for (const std::size_t k : {0, 1}) q.push_back(body->getParentJoint()->getPosition(k));
    return tipsOf(tree_, Bend::HINGES, q);
  }

 protected:
  void push(double factor) {
    skeleton_->clearExternalForces();
    for (std::size_t i = 0; factor != 0.0 && i < load_.links.size(); ++i)
      bodies_[static_cast<std::size_t>(load_.links[i])]->addExtForce(
          factor * load_.force[i], Eigen::Vector3d(0.0, 0.0, load_.along[i]));
  }

  const TestTree& tree_;
  const TestLoad& load_;
  dart::dynamics::SkeletonPtr skeleton_;
  std::vector<BodyNode*> bodies_;

 private:
  void add(std::size_t index) {
    const TestLink& link = tree_.links[index];
    UniversalJoint::Properties joint;
    joint.mName = "joint_" + std::to_string(index);
    joint.mAxis = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
    joint.mT_ParentBodyToJoint.translation() = Eigen::Vector3d(0.0, 0.0, link.h);
    joint.mT_ParentBodyToJoint.linear() =
        Eigen::Quaterniond(link.rest.w, link.rest.x, link.rest.y, link.rest.z).toRotationMatrix();
    joint.mSpringStiffnesses.setConstant(link.stiffness);
    joint.mDampingCoefficients.setConstant(link.damping);
    BodyNode::Properties body;
    body.mName = "branch_" + std::to_string(index);
    const double centre = 0.5 * link.length, across = link.across - link.mass * centre * centre;
    body.mInertia =
        dart::dynamics::Inertia(link.mass, Eigen::Vector3d(0.0, 0.0, centre),
                                Eigen::Vector3d(across, across, link.along).asDiagonal());
    BodyNode* parent = link.parent < 0 ? nullptr : bodies_[static_cast<std::size_t>(link.parent)];
    bodies_.push_back(
        skeleton_->createJointAndBodyNodePair<UniversalJoint>(parent, joint, body).second);
  }
};

// The linearly implicit midpoint with the engine's articulated bodies. The engine takes springs and
// dampers implicitly over its time step, so it gets half of ours, at positions half a step ahead
// with the springs' rest ahead by as much. Velocity products are those at the start.
class MidpointDart final : public DartEngine {
 public:
  using DartEngine::DartEngine;

  void rest() override {
    skeleton_->resetPositions(), skeleton_->resetVelocities();
    setRest(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(skeleton_->getNumDofs())));
  }

  void step(int interval, double time, double h) override {
    if (skeleton_->getTimeStep() != 0.5 * h) skeleton_->setTimeStep(0.5 * h);
    const Eigen::VectorXd rate = skeleton_->getVelocities();
    const Eigen::VectorXd ahead = 0.5 * h * rate;
    skeleton_->setPositions(skeleton_->getPositions() + ahead);
    setRest(ahead);
    push(load_.factor(interval, time + 0.5 * h));
    skeleton_->computeForwardDynamics();
    const Eigen::VectorXd change = h * skeleton_->getAccelerations();
    skeleton_->setPositions(skeleton_->getPositions() + ahead + 0.5 * h * change);
    skeleton_->setVelocities(rate + change);
  }

 private:
  void setRest(const Eigen::VectorXd& rest) {
    Eigen::Index i = 0;
    for (BodyNode* body : bodies_)
      for (const std::size_t k : {0, 1}) body->getParentJoint()->setRestPosition(k, rest[i++]);
  }
};

template <class ENGINE>
Maker maker(const char* name) {
  Maker out;
  out.name = name;
  out.peer = true;
  out.bend = Bend::HINGES;
  out.most_branches = 1000;
  out.make = [](const TestTree& tree, const TestLoad& load,
                const std::string&) -> std::unique_ptr<Engine> {
    return std::make_unique<ENGINE>(tree, load);
  };
  return out;
}

}  // namespace

std::vector<Maker> dartEngines() {
  return {maker<DartEngine>("DART"), maker<MidpointDart>("DART, our midpoint")};
}

}  // namespace vegetation_sim::bench
