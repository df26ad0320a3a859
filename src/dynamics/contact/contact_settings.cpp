// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/contact/contact_settings.h"

namespace vegetation_sim::physics {

void describe(FieldVisitor& v, ContactLaw& law) {
  v.number("contact_stiffness", law.stiffness, "N/m", {1e3, 1e8});
  v.number("contact_force_limit", law.force_limit, "N", {1.0, 1e6});
  v.number("contact_force_rate", law.force_rate, "N/s", {10.0, 1e9});
  v.number("contact_push_speed", law.push_speed, "m/s", {0.01, 100.0});
}

}  // namespace vegetation_sim::physics
