// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/common/fields.h"
#include "vegetation_sim/common/vectors.h"

namespace vegetation_sim::physics {

/// Force between a body and a branch: a spring on the overlap, taken at the end of the step, whose
/// force is limited (docs/contact.md).
struct ContactLaw {
  double stiffness{5e5};      ///< [N/m]; no step is too long for it
  double force_limit{500.0};  ///< per contact [N]
  double push_speed{1.0};     ///< at which an overlap is undone at most [m/s]
};
void describe(FieldVisitor& visitor, ContactLaw& law);

/// A link that touches a moving body, or may during the step, where both are at its start.
struct Contact {
  int link{0};
  double along{0.0};           ///< of the point on the link's axis [m]
  Vec3 normal{Vec3::UnitZ()};  ///< from body to link, unit, world axes
  double gap{0.0};             ///< between the surfaces, along the normal; negative: overlap [m]
  Vec3 surface{Vec3::Zero()};  ///< velocity of the body there, world [m/s]
  std::size_t touch{0};        ///< whatever the caller knows it by
  double force{0.0};           ///< on the link along the normal [N]: a guess, then what it was
  bool limited{false};         ///< the force was at its limit
};

}  // namespace vegetation_sim::physics
