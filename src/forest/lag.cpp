// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/lag.h"

#include <algorithm>

#include "vegetation_sim/forest/modal_tree.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {
namespace {

constexpr int SAMPLES = 2;         // trees measured per species and scale
constexpr int RATE = 20;           // looks a second
constexpr int WARM_UP = 3 * RATE;  // until the start is forgotten
constexpr int LOOKS = 15 * RATE;
constexpr double STRANGER = 1.1;  // trees that were not measured may be off so much more

wind::Field breeze() {
  wind::Primitive out;
  out.id = 1;
  out.name = "breeze";
  out.kind = static_cast<int>(wind::Kind::BREEZE);
  out.fade_in = out.fade_out = 0.0;
  out.velocity = Vec3(4.0, 1.0, 0.0);  // weak enough that drag is linear in what comes and goes
  return wind::Field({out}, 7);
}

// Largest distance of any wind point between amplitudes and the static answer to their load.
double farthest(const ModalTree& modal, const std::vector<double>& load,
                const std::vector<double>& amplitude) {
  double out = 0.0;
  for (const WindPoint& point : modal.windPoints()) {
    Vec3 off = Vec3::Zero();
    for (std::size_t m = 0; m < amplitude.size(); ++m) {
      const double w = modal.modes().frequency[m];
      off += (amplitude[m] - load[m] / (w * w)) * point.push[m];
    }
    out = std::max(out, length(off) / point.drag);
  }
  return out;
}

double lagOf(const Tree& tree, const Species& species, const wind::Field& field) {
  const ModalTree modal(tree, species);
  physics::ModalStepper stepper(modal.modes());
  physics::ModalState state = stepper.atRest();
  std::vector<double> before, after;
  AirSampler air;
  double out = 0.0;
  for (int look = 0; look < LOOKS; ++look) {
    const wind::Instant now = field.at(fromSeconds(static_cast<double>(look) / RATE));
    modal.loadOf(now, air, after);
    if (look > 0) stepper.step(before, after, 1.0 / RATE, state);
    before = after;
    if (look >= WARM_UP)
      out = std::max(out, farthest(modal, after, state.amplitude) / now.gustBound(tree.foot, 0.0));
  }
  return out;
}

}  // namespace

double measureLag(const Species& species, const MotionLaw& law, double scale) {
  if (static_cast<JointModel>(law.joint_model) != JointModel::SWING) return 0.0;
  const wind::Field field = breeze();
  double out = 0.0;
  for (int sample = 0; sample < SAMPLES; ++sample) {
    Tree tree;
    tree.seed.seed = static_cast<std::uint64_t>(sample) + 1;
    tree.seed.scale = scale;
    tree.skeleton = grow(tree.seed, species);
    out = std::max(out, STRANGER * lagOf(tree, species, field));
  }
  return out;
}

}  // namespace vegetation_sim::forest
