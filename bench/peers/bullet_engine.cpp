// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include "trees/engine.h"

namespace vegetation_sim::bench {
namespace {

btVector3 toBullet(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btQuaternion toBullet(const Quat& q) {
  return {static_cast<btScalar>(q.x), static_cast<btScalar>(q.y), static_cast<btScalar>(q.z),
          static_cast<btScalar>(q.w)};
}

// Two hinges per branch, the first of which carries a body without mass. Springs and dampers are
// joint torques of the last state, as the engine's world would apply them; the world itself adds
// only overhead.
class BulletEngine : public Engine {
 public:
  BulletEngine(const TestTree& tree, const TestLoad& load)
      : tree_(tree),
        load_(load),
        body_(2 * static_cast<int>(tree.links.size()), 0, btVector3(1, 1, 1), true, false) {
    for (int i = 0; i < static_cast<int>(tree.links.size()); ++i) add(i);
    body_.finalizeMultiDof();
    body_.setLinearDamping(0);
    body_.setAngularDamping(0);
    body_.setMaxCoordinateVelocity(1e6f);
    body_.setUseGyroTerm(true);
    body_.setBaseWorldTransform(btTransform::getIdentity());
  }

  void rest() override {
    body_.clearVelocities();
    for (int i = 0; i < body_.getNumLinks(); ++i) {
      body_.setJointPos(i, 0);
      body_.setJointVel(i, 0);
    }
    btAlignedObjectArray<btQuaternion> turns;
    btAlignedObjectArray<btVector3> origins;
    body_.forwardKinematics(turns, origins);
  }

  void step(int interval, double time, double h) override {
    body_.clearForcesAndTorques();
    for (std::size_t i = 0; i < tree_.links.size(); ++i) {
      const auto stiffness = static_cast<btScalar>(tree_.links[i].stiffness),
                 damping = static_cast<btScalar>(tree_.links[i].damping);
      for (int k = 0; k < 2; ++k) {
        const int link = 2 * static_cast<int>(i) + k;
        body_.addJointTorque(
            link, -stiffness * body_.getJointPos(link) - damping * body_.getJointVel(link));
      }
    }
    push(load_.factor(interval, time + 0.5 * h));
    const auto step = static_cast<btScalar>(h);
    body_.computeAccelerationsArticulatedBodyAlgorithmMultiDof(step, numbers_, vectors_, matrices_,
                                                               false, false, false);
    body_.stepPositionsMultiDof(step);
  }

  std::vector<Vec3> tips() const override {
    std::vector<double> q;
    for (int i = 0; i < body_.getNumLinks(); ++i) q.push_back(body_.getJointPos(i));
    return tipsOf(tree_, Bend::HINGES, q);
  }

 private:
  void add(int index) {
    const TestLink& link = tree_.links[static_cast<std::size_t>(index)];
    const bool rooted = link.parent < 0;
    const double borne =
        rooted ? 0.0 : 0.5 * tree_.links[static_cast<std::size_t>(link.parent)].length;
    body_.setupRevolute(2 * index, 0, btVector3(0, 0, 0), rooted ? -1 : 2 * link.parent + 1,
                        toBullet(conjugate(link.rest)), btVector3(1, 0, 0),
                        toBullet(Vec3(0.0, 0.0, link.h - borne)), btVector3(0, 0, 0), true);
    const double centre = 0.5 * link.length, across = link.across - link.mass * centre * centre;
    body_.setupRevolute(2 * index + 1, static_cast<btScalar>(link.mass),
                        toBullet(Vec3(across, across, link.along)), 2 * index,
                        btQuaternion::getIdentity(), btVector3(0, 1, 0), btVector3(0, 0, 0),
                        toBullet(Vec3(0.0, 0.0, centre)), true);
  }

  // Forces act on centres of mass, so a force elsewhere needs a torque.
  void push(double factor) {
    if (factor == 0.0) return;
    for (std::size_t i = 0; i < load_.links.size(); ++i) {
      const int link = 2 * load_.links[i] + 1;
      const Vec3 force = factor * load_.force[i];
      const double off =
          load_.along[i] - 0.5 * tree_.links[static_cast<std::size_t>(load_.links[i])].length;
      body_.addLinkForce(link, toBullet(force));
      if (off == 0.0) continue;
      const btVector3 arm = body_.localDirToWorld(link, toBullet(Vec3(0.0, 0.0, off)));
      body_.addLinkTorque(link, arm.cross(toBullet(force)));
    }
  }

  const TestTree& tree_;
  const TestLoad& load_;
  btMultiBody body_;
  btAlignedObjectArray<btScalar> numbers_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
};

}  // namespace

std::vector<Maker> bulletEngines() {
  Maker out;
  out.name = "Bullet, float";
  out.peer = true;
  out.bend = Bend::HINGES;
  out.make = [](const TestTree& tree, const TestLoad& load,
                const std::string&) -> std::unique_ptr<Engine> {
    return std::make_unique<BulletEngine>(tree, load);
  };
  return {out};
}

}  // namespace vegetation_sim::bench
