// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::physics {

/// Force between a body and a branch: a spring on the overlap, taken at the end of the step, whose
/// force is limited (docs/contact.md). Wood of some contacts bears a multiple (Contact::bears).
struct ContactLaw {
  double stiffness{5e5};       ///< [N/m]; no step is too long for it
  double force_limit{2000.0};  ///< per contact [N]
  double force_rate{1e5};      ///< at which the force of a contact rises at most [N/s]
  double push_speed{1.0};      ///< at which an overlap is undone at most [m/s]
};
void describe(FieldVisitor& visitor, ContactLaw& law);

}  // namespace vegetation_sim::physics
