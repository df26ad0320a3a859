// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::physics {

/// Settings of the force between a body and a branch, which ContactStepper computes: a spring on
/// the overlap, evaluated at the end of the step, whose force is limited (docs/contact.md). In a
/// contact with harder wood, limit and stiffness are a multiple (Contact::hardness).
struct ContactLaw {
  double stiffness{5e5};       ///< [N/m]; a step of any length is stable
  double force_limit{2000.0};  ///< per contact [N]
  double force_rate{1e5};      ///< largest rate at which the force of a contact rises [N/s]
  double push_speed{1.0};      ///< largest speed at which an overlap is undone [m/s]
};
void describe(FieldVisitor& visitor, ContactLaw& law);

}  // namespace vegetation_sim::physics
