// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/physics/tree_steps.h"

namespace vegetation_sim::forest {
namespace {

/// Distances from the held point to the springs of a grab, along the branch [m].
class SpringOffsets {
 public:
  explicit SpringOffsets(double jaw_length)
      : size_(jaw_length > 0.0 ? 2 : 1), offsets_{-0.5 * jaw_length, 0.5 * jaw_length} {}
  std::size_t size() const { return size_; }
  double share() const { return 1.0 / static_cast<double>(size_); }  ///< of each in the whole
  double operator[](std::size_t i) const { return offsets_[i]; }
  const double* begin() const { return offsets_; }
  const double* end() const { return offsets_ + size_; }

 private:
  std::size_t size_;
  double offsets_[2];
};

}  // namespace

// Targets move in a straight line between ticks.
void TreeSteps::collectSprings(const StepTimes& times) {
  const double seconds = secondsBetween(times.from, times.to);
  for (const HeldGrab* grab : grabs_) {
    const Vec3 direction = jawDirection(*grab);
    const SpringOffsets offsets(grab->jaw_length);
    for (const double offset : offsets) {
      const Vec3 target = grab->target + offset * direction;
      const Vec3 last = grab->last_target + offset * grab->last_direction;
      Vec3 velocity = Vec3::Zero();
      if (seconds > 0.0) velocity = (target - last) / seconds;
      BranchPoint point = grab->point;
      point.along += offset;
      loads_.springs.push_back({point, target - subtree_->tree().foot, velocity, times.to,
                                grab->stiffness * offsets.share(), grab->damping * offsets.share(),
                                grab->force_limit * offsets.share()});
    }
  }
}

// Adds the impulse of the grabs between two stamps: springs by the positions at both, dampers by
// the displacement. Equal stamps begin a tick.
void TreeSteps::accumulateImpulses(const TreeWind& air, SubtreeScratch& scratch, Nanoseconds from,
                                   Nanoseconds to) {
  if (grabs_.empty()) return;
  std::vector<Vec3>& places = scratch.places;
  subtree_->placesAt(loads_.springs, air, to, scratch, places);
  const SubtreeSpring* springs = loads_.springs.data();
  const Vec3* place = places.data();
  for (HeldGrab* grab : grabs_) {
    const std::size_t count = SpringOffsets(grab->jaw_length).size();
    accumulateImpulse(springs, place, from, to, *grab);
    springs += count;
    place += count;
  }
}

// Adds the impulse of one grab, whose springs are at `places` now.
void TreeSteps::accumulateImpulse(const SubtreeSpring* springs, const Vec3* places,
                                  Nanoseconds from, Nanoseconds to, HeldGrab& grab) const {
  const SpringOffsets offsets(grab.jaw_length);
  const Vec3 grip = grab.grip, axis = grab.axis;  // before
  grab.grip = places[0];
  if (offsets.size() == 2) {
    grab.grip = 0.5 * (places[0] + places[1]);
    grab.axis = (places[1] - places[0]) / grab.jaw_length;
  }
  if (subtree_->linkOf(grab.point.branch) < 0) return;
  const double h = secondsBetween(from, to);
  const bool begins = h <= 0.0;
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
  bool limited = false;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const double offset = offsets[i];
    const Vec3 was = grip + offset * axis;
    const SpringForce f = begins ? forceOf(springs[i], to, places[i], springs[i].velocity)
                                 : forceOf(springs[i], from + (to - from) / 2,
                                           0.5 * (was + places[i]), (places[i] - was) / h);
    const Vec3 arm = offset * (begins ? grab.axis : Vec3(0.5 * (axis + grab.axis)));
    force += f.force;
    torque += cross(arm, f.force);
    limited = limited || f.scale < 1.0;
  }
  if (begins) {
    grab.force = force;
    grab.torque = torque;
    grab.impulse = grab.angular_impulse = Vec3::Zero();
    grab.limited = limited;
  } else {
    grab.impulse += h * force;
    grab.angular_impulse += h * torque;
    grab.limited = grab.limited || limited;
  }
}

// Reactions of springs are means over the tick, with their whole impulse; after a gap in time, the
// present forces.
void TreeSteps::recordGrabs(double duration) {
  for (HeldGrab* grab : grabs_) {
    if (subtree_->linkOf(grab->point.branch) < 0) continue;
    if (duration > 0.0) {
      grab->force = grab->impulse / duration;
      grab->torque = grab->angular_impulse / duration;
    }
    Reaction out;
    out.grab = grab->id;
    out.frame = grab->frame;
    out.holder = grab->holder;
    out.at = grab->point;
    out.point = subtree_->tree().foot + grab->grip;
    out.force = -grab->force;
    out.torque -= grab->torque;  // without a jaw +0, which -0 would not equal bit by bit
    out.limited = grab->limited;
    grab_reactions_.push_back(out);
  }
}

}  // namespace vegetation_sim::forest
