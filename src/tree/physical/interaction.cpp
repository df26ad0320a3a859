// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/physical/interaction.h"

#include <cmath>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::forest {
namespace {

constexpr Range ANYWHERE{-1e7, 1e7};  // [m]
constexpr Range FORCE{-1e5, 1e5};     // [N]
constexpr Range OFFSETS{-1e3, 1e3};   // [m]
constexpr Range LENGTHS_OF_JAWS{0.0, 1.0};
constexpr double UNIT_ROUNDING = 1e-6;  // of the length of a unit vector
constexpr std::size_t LONGEST_NAME = 256;

}  // namespace

void checkOrientation(const Quat& q, const std::string& name, Faults& faults) {
  const std::string fault = rangeFault(name + "'s norm", normOf(q), "", {0.999, 1.001});
  if (!fault.empty()) faults.add(fault);
}

void checkHolder(const Pose& holder, Faults& faults) {
  Vec3 position = holder.position;
  FieldChecker("grab: ", faults).vector("holder.position", position, "m", ANYWHERE);
  checkOrientation(holder.orientation, "grab: holder.orientation", faults);
}

void check(const Grab& grab, Faults& faults) {
  FieldChecker checker("grab: ", faults);
  Grab copy = grab;
  checker.vector("target", copy.target, "m", ANYWHERE);
  checker.number("stiffness", copy.stiffness, "N/m", {1.0, 1e6});
  checker.number("damping", copy.damping, "N s/m", {0.0, 1e5});
  checker.number("force_limit", copy.force_limit, "N", {0.01, 1e5});
  if (copy.lease != 0.0) checker.number("lease", copy.lease, "s", {0.1, 3600.0});
  checker.vector("offset", copy.offset, "m", OFFSETS);
  checker.number("jaw_length", copy.jaw_length, "m", LENGTHS_OF_JAWS);
  checker.vector("direction", copy.direction, "", {-1.0 - UNIT_ROUNDING, 1.0 + UNIT_ROUNDING});
  if (std::abs(length(grab.direction) - 1.0) > UNIT_ROUNDING)
    faults.add("grab: length of direction = " + std::to_string(length(grab.direction)) +
               " is not 1");
  checkHolder(grab.holder, faults);
  if (grab.frame.size() > LONGEST_NAME)
    faults.add("grab: frame is longer than " + std::to_string(LONGEST_NAME) + " characters");
}

void check(const Push& push, Faults& faults) {
  FieldChecker checker("push: ", faults);
  Vec3 force = push.force;
  checker.vector("force", force, "N", FORCE);
}

}  // namespace vegetation_sim::forest
