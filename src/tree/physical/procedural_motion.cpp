// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/physical/procedural_motion.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

constexpr double STEP = static_cast<double>(WINDOW_STEP) * 1e-9;  // [s]

Quat difference(const Quat& a, const Quat& b) {
  return {a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z};
}

// Returns the vector part of 2 change * conj(q): the angular velocity if `change` is the rate of q,
// its rate if `change` is the second rate, because rate * conj(rate) has no vector part.
Vec3 spinOf(const Quat& change, const Quat& q) {
  const Quat product = change * conjugate(q);
  return {2.0 * product.x, 2.0 * product.y, 2.0 * product.z};
}

JointAngles bendOf(const Tree& tree, int branch, const Vec3& air, double weight) {
  const Vec3 velocity = effectiveVelocity(air, tree.drag, tree.reference_speed);
  return deviation(tree.response[static_cast<std::size_t>(branch)], velocity, weight,
                   tree.joint_model);
}

// Blends procedural angles with modal ones.
JointAngles inModes(const ModalSamples& modal, int branch, std::size_t look, double share,
                    const JointAngles& procedural) {
  return interpolate(procedural, bendOf(modal.modal_state->modes(), modal.amplitude[look], branch),
                     share);
}

// Returns the angles in this wind and in the modes.
JointAngles anglesAt(const ProceduralMotion& motion, int branch, std::size_t look,
                     const Vec3& air) {
  const Branch& b = motion.tree.skeleton.branches[static_cast<std::size_t>(branch)];
  const double weight = motion.weights[look][static_cast<std::size_t>(b.depth)];
  const double share = motion.modalShare(look);
  JointAngles out;
  if (weight > 0.0 && share < 1.0) out = bendOf(motion.tree, branch, air, weight);
  if (share > 0.0) out = inModes(*motion.modal, branch, look, share, out);
  return out;
}

// Computes central differences.
JointMotion motionOf(const JointAngles& a, const JointAngles& b, const JointAngles& c) {
  const double twice = 2.0 * STEP, square = STEP * STEP;
  return {b,
          {(c.first - a.first) / twice, (c.second - a.second) / twice},
          {((c.first - b.first) - (b.first - a.first)) / square,
           ((c.second - b.second) - (b.second - a.second)) / square}};
}

}  // namespace

void ModalSamples::sampleAt(const ModalTreeState& at, Nanoseconds stamp) {
  modal_state = &at;
  at.interpolateMotion(stamp, motion);
  for (std::size_t look = 0; look < amplitude.size(); ++look) {
    const double ahead = (static_cast<double>(look) - 1.0) * STEP;
    amplitude[look] = motion.amplitude;
    for (std::size_t m = 0; m < motion.rate.size(); ++m)
      amplitude[look][m] += ahead * (motion.rate[m] + 0.5 * ahead * motion.acceleration[m]);
  }
}

ProceduralMotion::ProceduralMotion(const Tree& tree, const WindWindow& wind,
                                   const LevelState& level, const MotionLaw& law,
                                   const ModalSamples* modal)
    : tree(tree), wind(wind), modal(modal) {
  for (std::size_t look = 0; look < 3; ++look)
    weights[look] =
        weightsAt(level, wind.stamp() + (static_cast<Nanoseconds>(look) - 1) * WINDOW_STEP, law);
}

JointMotion ProceduralMotion::at(int branch) const {
  const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(branch)];
  const std::array<Vec3, 3> air = wind.velocities(tree.foot + b.rest.position);
  std::array<JointAngles, 3> angles;
  for (std::size_t look = 0; look < 3; ++look)
    angles[look] = anglesAt(*this, branch, look, air[look]);
  return motionOf(angles[0], angles[1], angles[2]);
}

void ProceduralMotions::update(const ProceduralMotion& motion, const std::vector<int>& branches) {
  const Tree& tree = motion.tree;
  air_.clear();
  for (const int branch : branches)
    air_.add(tree.foot + tree.skeleton.branches[static_cast<std::size_t>(branch)].rest.position);
  const auto needs_air = [&](std::size_t look) { return motion.modalShare(look) < 1.0; };
  if (needs_air(0) || needs_air(1) || needs_air(2)) air_.sample(motion.wind);
  for (std::size_t look = 0; look < angles_.size(); ++look) {
    const bool in_air = needs_air(look);
    angles_[look].resize(branches.size());
    for (std::size_t i = 0; i < branches.size(); ++i) {
      const Vec3 air = in_air ? air_.velocity(i, look) : Vec3(Vec3::Zero());
      angles_[look][i] = anglesAt(motion, branches[i], look, air);
    }
  }
}

JointMotion ProceduralMotions::at(std::size_t i) const {
  return motionOf(angles_[0][i], angles_[1][i], angles_[2][i]);
}

void moveCarriers(const Tree& tree, const std::vector<int>& carriers,
                  const ProceduralMotions& motions, std::vector<Pose>& scratch,
                  std::vector<CarrierMotion>& out) {
  const std::size_t n = carriers.size();
  scratch.resize(3 * n);
  out.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(carriers[i])];
    const auto bearer = static_cast<std::size_t>(
        std::lower_bound(carriers.begin(), carriers.end(), b.parent) - carriers.begin());
    for (std::size_t look = 0; look < 3; ++look) {
      const Pose base = b.parent < 0 ? Pose() : scratch[3 * bearer + look];
      const Quat local = jointRotation(b, motions.angles(i, look), tree.joint_model);
      Vec3 position = base.position;
      if (b.parent >= 0) position += b.h * axisZ(base.orientation);
      scratch[3 * i + look] = {position, base.orientation * local};
    }
    const Pose &before = scratch[3 * i], &now = scratch[3 * i + 1], &after = scratch[3 * i + 2];
    CarrierMotion& motion = out[i];
    motion.pose = now;
    motion.velocity = (after.position - before.position) / (2.0 * STEP);
    motion.acceleration =
        ((after.position - now.position) - (now.position - before.position)) / (STEP * STEP);
    const Quat rise = difference(after.orientation, now.orientation);
    const Quat fall = difference(now.orientation, before.orientation);
    motion.spin =
        spinOf(difference(after.orientation, before.orientation), now.orientation) / (2.0 * STEP);
    motion.spin_rate = spinOf(difference(rise, fall), now.orientation) / (STEP * STEP);
  }
}

}  // namespace vegetation_sim::forest
