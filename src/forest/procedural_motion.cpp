// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/procedural_motion.h"

#include <algorithm>

namespace vegetation_sim::forest {
namespace {

constexpr double STEP = static_cast<double>(LOOK) * 1e-9;  // [s]

Quat difference(const Quat& a, const Quat& b) {
  return {a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z};
}

// Vector part of 2 change * conj(q): the spin where `change` is q's rate, and the spin's own rate
// where it is q's second rate, because rate * conj(rate) has no vector part.
Vec3 spinOf(const Quat& change, const Quat& q) {
  const Quat product = change * conjugate(q);
  return {2.0 * product.x, 2.0 * product.y, 2.0 * product.z};
}

}  // namespace

void WindWindow::lookAt(const wind::Field& field, Nanoseconds stamp) {
  stamp_ = stamp;
  field.at(stamp - LOOK, looks_[0]);
  field.at(stamp, looks_[1]);
  field.at(stamp + LOOK, looks_[2]);
}

Course::Course(const Tree& tree, const WindWindow& wind, const LevelState& level,
               const MotionLaw& law)
    : tree(tree), wind(wind) {
  for (std::size_t look = 0; look < 3; ++look)
    weights[look] =
        weightsAt(level, wind.stamp() + (static_cast<Nanoseconds>(look) - 1) * LOOK, law);
}

JointAngles Course::anglesAt(int branch, std::size_t look) const {
  const Branch& b = tree.skeleton.branches[static_cast<std::size_t>(branch)];
  const double weight = weights[look][static_cast<std::size_t>(b.depth)];
  if (weight <= 0.0) return {};
  const Vec3 velocity = effectiveVelocity(wind.looks()[look].velocity(tree.foot + b.rest.position),
                                          tree.drag, tree.reference_speed);
  return deviation(tree.response[static_cast<std::size_t>(branch)], velocity, weight,
                   tree.joint_model);
}

JointCourse Course::at(int branch) const {
  const JointAngles a = anglesAt(branch, 0), b = anglesAt(branch, 1), c = anglesAt(branch, 2);
  const double twice = 2.0 * STEP, square = STEP * STEP;
  return {b,
          {(c.first - a.first) / twice, (c.second - a.second) / twice},
          {((c.first - b.first) - (b.first - a.first)) / square,
           ((c.second - b.second) - (b.second - a.second)) / square}};
}

void moveCarriers(const Course& course, const std::vector<int>& carriers,
                  std::vector<Pose>& scratch, std::vector<CarrierMotion>& out) {
  const std::size_t n = carriers.size();
  scratch.resize(3 * n);
  out.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Branch& b = course.tree.skeleton.branches[static_cast<std::size_t>(carriers[i])];
    const auto bearer = static_cast<std::size_t>(
        std::lower_bound(carriers.begin(), carriers.end(), b.parent) - carriers.begin());
    for (std::size_t look = 0; look < 3; ++look) {
      const Pose base = b.parent < 0 ? Pose() : scratch[3 * bearer + look];
      const Quat local =
          jointRotation(b, course.anglesAt(carriers[i], look), course.tree.joint_model);
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
