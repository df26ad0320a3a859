// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::forest {

/// How the length of limbs varies along their parent.
enum class Crown : int { EVEN = 0, CONICAL = 1, ROUND = 2, FLAME = 3 };

/// Growth rules of the limbs of one recursion depth. The trunk (depth 0) ignores those that refer
/// to a parent.
struct LimbRule {
  double children{1.0};          ///< limbs per bearing limb
  int whorl{1};                  ///< limbs at the same height
  double start{0.2}, end{1.0};   ///< part of the parent that has children, as fractions
  double length{0.5};            ///< relative to the parent's length
  double length_variation{0.1};  ///< +- fraction
  Crown crown{Crown::EVEN};
  double radius{0.5};           ///< relative to the parent's radius at the joint
  double taper{0.4};            ///< tip radius / base radius
  double angle_low{1.0};        ///< to the parent, at the low end of its part with children [rad]
  double angle_high{0.7};       ///< the same at its upper end [rad]
  double angle_variation{0.1};  ///< +- [rad]
  double rise{0.0};             ///< total turn upwards; negative: downwards [rad]
  double wander{0.2};           ///< amplitude of the noise in direction, per limb [rad]
  int segments{2};              ///< joints per limb
  double leaves{0.0};           ///< leaf clusters per limb
};
void describe(FieldVisitor& visitor, LimbRule& rule);

}  // namespace vegetation_sim::forest
