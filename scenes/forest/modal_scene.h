// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/integration/integrator.h"
#include "scenes/forest/forest_fixture.h"
#include "tree/growth/branch_mass.h"
#include "vegetation_sim/tree/modal/modal_tree_state.h"

// One tree in a wind on every tier; shared by tests and bench.

namespace vegetation_sim::forest {

constexpr Nanoseconds MODAL_START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int MODAL_RATE = 60;

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

/// One species in a wind: its tips by procedural, modal and full dynamics, each started at rest.
class Swaying {
 public:
  Swaying(std::uint32_t id, const wind::Field& field, double duration)
      : Swaying(groundedTree(gridLayout(2, 12.0), id), shippedSpecies(speciesNames()[id % 4]),
                field, duration) {}
  Swaying(Tree tree, Species species, const wind::Field& field, double duration, int steps = 8)
      : steps_(steps),
        tree_(std::move(tree)),
        species_(std::move(species)),
        field_(field),
        frames_(static_cast<int>(duration * MODAL_RATE)),
        rest_(tipsOf(tree_, std::vector<JointAngles>(tree_.skeleton.branches.size()))) {
    runFull();
  }

  const Tree& tree() const { return tree_; }
  const Species& species() const { return species_; }
  const wind::Field& field() const { return field_; }
  double proceduralError() const { return procedural(0.0).relative; }
  double modalError(ModalDepth depth = {}) const { return modal(0.0, depth).relative; }

  /// Errors against the full chain, after `skip` seconds.
  struct Off {
    double relative;  ///< RMS over all tips, relative to their motion
    double farthest;  ///< of any tip [m]
  };
  Off procedural(double skip) const {
    return error(skip, [&](int frame) {
      return proceduralAngles(tree_, field_.at(stampOf(frame)), fullWeights());
    });
  }
  /// `turning`: lever arms rotate as the tree bends.
  Off modal(double skip, ModalDepth depth = {}, bool turning = true) const {
    ModalTreeState modal_state(std::make_shared<const ModalTree>(tree_, species_, depth));
    std::vector<ModalLoad> loads(2);
    modal_state.loadOf(field_.at(MODAL_START), loads[0]);
    modal_state.restore(modal_state.state(), loads[0], MODAL_START);
    return error(skip, [&](int frame) {
      modal_state.loadOf(field_.at(stampOf(frame)), loads[1]);
      if (!turning)
        for (ModalLoad& load : loads) load.air.setZero();
      modal_state.step(loads, stampOf(frame));
      loads[0] = loads[1];
      return modal_state.modes().bendsOf(modal_state.state().amplitude);
    });
  }

 private:
  Nanoseconds stampOf(int frame) const {
    return MODAL_START + fromSeconds((frame + 1.0) / MODAL_RATE);
  }

  template <class Bends>
  Off error(double skip, const Bends& bends) const {
    double off = 0.0, size = 0.0, farthest = 0.0;
    for (int frame = 0; frame < frames_; ++frame) {
      const std::vector<JointAngles> bent = bends(frame);
      if (frame < skip * MODAL_RATE) continue;
      const std::vector<Vec3> tips = tipsOf(tree_, bent);
      const std::vector<Vec3>& right = full_[static_cast<std::size_t>(frame)];
      for (std::size_t i = 0; i < tips.size(); ++i) {
        const double square = (tips[i] - right[i]).squaredNorm();
        off += square;
        size += (right[i] - rest_[i]).squaredNorm();
        farthest = std::max(farthest, square);
      }
    }
    return {std::sqrt(off / size), std::sqrt(farthest)};
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
      if (time != looked) field_.at(MODAL_START + fromSeconds(looked = time), air);
      for (std::size_t i = 0; i < links.size(); ++i) {
        if (wood.own[i].drag <= 0.0) continue;
        const Vec3 centre = wood.own[i].drag_moment / wood.own[i].drag;
        const Vec3 arm = rotate(k.pose[i].orientation, centre);
        const Vec3 wind = air.velocity(k.pose[i].position + arm);
        const Vec3 force = wood.own[i].drag * (wind - k.velocity[i] - cross(k.spin[i], arm));
        loads.wrench[i] = {force, cross(arm, force)};
      }
    };
    const double h = 1.0 / (MODAL_RATE * steps_);
    for (int i = 0; i < frames_ * steps_; ++i) {
      stepper.step(physics::Integrator::MIDPOINT, links, around, i * h, h, state, theta);
      if (i % steps_ != steps_ - 1) continue;
      std::vector<JointAngles> bends;
      for (const physics::Vec2& q : state.q) bends.push_back({q.x(), q.y()});
      full_.push_back(tipsOf(tree_, bends));
    }
  }

  int steps_;  // a frame
  Tree tree_;
  Species species_;
  wind::Field field_;
  int frames_;
  std::vector<Vec3> rest_;
  std::vector<std::vector<Vec3>> full_;
};

}  // namespace vegetation_sim::forest
