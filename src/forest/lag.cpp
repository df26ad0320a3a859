// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/lag.h"

#include <algorithm>

#include "vegetation_sim/forest/level.h"
#include "vegetation_sim/forest/modal_tree.h"
#include "vegetation_sim/forest/response.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {
namespace {

constexpr int SAMPLES = 2;         // trees measured per species and scale
constexpr int RATE = 20;           // looks a second
constexpr int WARM_UP = 3 * RATE;  // until the start is forgotten
constexpr int LOOKS = 10 * RATE;
constexpr int STRIDE = RATE / 4;     // from one comparison of tips to the next
constexpr double FULL_CHAIN = 0.88;  // of the modes' lag, in the mean of seeds 1 to 4
constexpr double STRANGER = 1.1;     // trees that were not measured may turn so much more

wind::Field breeze() {
  wind::Primitive out;
  out.id = 1;
  out.name = "breeze";
  out.kind = static_cast<int>(wind::Kind::BREEZE);
  out.fade_in = out.fade_out = 0.0;
  out.velocity = Vec3(4.0, 1.0, 0.0);  // weak enough that drag is linear in what comes and goes
  return wind::Field({out}, 7);
}

// Largest distance of any tip between modes and the procedural motion.
double farthest(const Tree& tree, const ModalTree& modal, const std::vector<double>& amplitude,
                const wind::Instant& now) {
  std::vector<JointAngles> bends = modal.bendsOf(amplitude);
  for (JointAngles& bend : bends) bend = limited(bend);
  const std::vector<Pose> sways = forwardKinematics(tree, bends);
  Weights all;
  all.fill(1.0);
  const std::vector<Pose> follows = poseBranches(tree, now, all);
  double out = 0.0;
  for (std::size_t i = 0; i < sways.size(); ++i) {
    const Branch& branch = tree.skeleton.branches[i];
    out = std::max(out, length(tipOf(branch, sways[i]) - tipOf(branch, follows[i])));
  }
  return out;
}

void raise(const Tree& tree, const Species& species, const wind::Field& field, Lag& out) {
  const ModalTree modal(tree, species);
  physics::ModalStepper stepper(modal.modes());
  physics::ModalState state = stepper.atRest();
  std::vector<double> before, after;
  ModalAir air;
  for (int look = 0; look < LOOKS; ++look) {
    const wind::Instant now = field.at(fromSeconds(static_cast<double>(look) / RATE));
    modal.loadOf(now, air, after);
    if (look > 0) stepper.step(before, after, 1.0 / RATE, state);
    before = after;
    if (look < WARM_UP || look % STRIDE != 0) continue;
    const double off =
        FULL_CHAIN * farthest(tree, modal, state.amplitude, now) / now.gustBound(tree.foot, 0.0);
    const double turn = modal.probe().largestTurn(state) / now.speedBound(tree.foot, 0.0);
    out.distance = std::max(out.distance, off);
    out.turn = std::max(out.turn, STRANGER * turn);
  }
}

}  // namespace

Lag measureLag(const Species& species, const MotionLaw& law, double scale) {
  Lag out;
  if (static_cast<JointModel>(law.joint_model) != JointModel::SWING) return out;
  const wind::Field field = breeze();
  for (int sample = 0; sample < SAMPLES; ++sample) {
    Tree tree;
    tree.seed.seed = static_cast<std::uint64_t>(sample) + 1;
    tree.seed.scale = scale;
    tree.skeleton = grow(tree.seed, species);
    tree.response = windResponse(tree.skeleton, species, law);
    tree.joint_model = JointModel::SWING;
    raise(tree, species, field, out);
  }
  return out;
}

}  // namespace vegetation_sim::forest
