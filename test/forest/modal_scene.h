// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <vector>

#include "forest/forest_fixture.h"
#include "vegetation_sim/forest/modal_tree.h"
#include "vegetation_sim/forest/wood.h"
#include "vegetation_sim/physics/integrator.h"

// One tree in a wind, on every rung; shared by tests and bench.

namespace vegetation_sim::forest {

constexpr Nanoseconds SWAY_START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int SWAY_RATE = 60;

inline Tree groundedTree(const Layout& layout, std::uint32_t id) {
  Tree out = growTree(layout, id, terrain::HeightMap());
  out.foot.setZero();
  return out;
}

inline std::vector<Vec3> tipsOf(const Tree& tree, const std::vector<JointAngles>& bends) {
  const std::vector<Pose> poses = forwardKinematics(tree, bends);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < poses.size(); ++i)
    out.push_back(tipOf(tree.skeleton.branches[i], poses[i]));
  return out;
}

/// One species in a wind: its tips as procedural, modal and full dynamics have them, each started
/// at rest.
class Swaying {
 public:
  Swaying(std::uint32_t id, const wind::Field& field, double duration)
      : layout_(gridLayout(2, 12.0)),
        tree_(groundedTree(layout_, id)),
        species_(layout_.species[tree_.seed.species]),
        field_(field),
        frames_(static_cast<int>(duration * SWAY_RATE)),
        rest_(tipsOf(tree_, std::vector<JointAngles>(tree_.skeleton.branches.size()))) {
    runFull();
  }

  const Tree& tree() const { return tree_; }
  const Species& species() const { return species_; }
  const wind::Field& field() const { return field_; }
  double proceduralError() const {
    return error([&](int frame) {
      return proceduralAngles(tree_, field_.at(stampOf(frame)), fullWeights());
    });
  }
  double modalError(ModalDepth depth = {}) const {
    const ModalTree modal(tree_, species_, depth);
    physics::ModalStepper stepper(modal.modes());
    physics::ModalState state = stepper.atRest();
    std::vector<double> before, after;
    AirSampler air;
    modal.loadOf(field_.at(SWAY_START), air, before);
    return error([&](int frame) {
      modal.loadOf(field_.at(stampOf(frame)), air, after);
      stepper.step(before, after, 1.0 / SWAY_RATE, state);
      before = after;
      return modal.bendsOf(state.amplitude);
    });
  }

 private:
  static constexpr int STEPS = 8;  // a frame
  Nanoseconds stampOf(int frame) const {
    return SWAY_START + fromSeconds((frame + 1.0) / SWAY_RATE);
  }

  template <class Bends>
  double error(const Bends& bends) const {
    double off = 0.0, size = 0.0;
    for (int frame = 0; frame < frames_; ++frame) {
      const std::vector<Vec3> tips = tipsOf(tree_, bends(frame));
      const std::vector<Vec3>& right = full_[static_cast<std::size_t>(frame)];
      for (std::size_t i = 0; i < tips.size(); ++i) {
        off += (tips[i] - right[i]).squaredNorm();
        size += (right[i] - rest_[i]).squaredNorm();
      }
    }
    return std::sqrt(off / size);
  }

  void runFull() {
    const std::vector<physics::Link> links = chainOf(tree_.skeleton, species_);
    const Wood wood = woodOf(tree_.skeleton, species_, Material::BEAM);
    const std::vector<physics::Vec2> none(links.size(), physics::Vec2::Zero());
    physics::ChainState state{none, none};
    physics::ChainStepper stepper;
    double theta = 0.5;
    wind::Instant air;
    double looked = -1.0;
    physics::Surroundings around;
    around.loads = [&](const physics::Kinematics& k, double time, physics::Loads& loads) {
      if (time != looked) field_.at(SWAY_START + fromSeconds(looked = time), air);
      for (std::size_t i = 0; i < links.size(); ++i) {
        if (wood.own[i].drag <= 0.0) continue;
        const Vec3 centre = wood.own[i].drag_moment / wood.own[i].drag;
        const Vec3 arm = rotate(k.pose[i].orientation, centre);
        const Vec3 wind = air.velocity(k.pose[i].position + arm);
        const Vec3 force = wood.own[i].drag * (wind - k.velocity[i] - cross(k.spin[i], arm));
        loads.wrench[i] = {force, cross(arm, force)};
      }
    };
    const double h = 1.0 / (SWAY_RATE * STEPS);
    for (int i = 0; i < frames_ * STEPS; ++i) {
      stepper.step(physics::Integrator::MIDPOINT, links, around, i * h, h, state, theta);
      if (i % STEPS != STEPS - 1) continue;
      std::vector<JointAngles> bends;
      for (const physics::Vec2& q : state.q) bends.push_back({q.x(), q.y()});
      full_.push_back(tipsOf(tree_, bends));
    }
  }

  Layout layout_;
  Tree tree_;
  Species species_;
  wind::Field field_;
  int frames_;
  std::vector<Vec3> rest_;
  std::vector<std::vector<Vec3>> full_;
};

}  // namespace vegetation_sim::forest
