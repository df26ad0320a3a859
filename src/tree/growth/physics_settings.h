// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/contact/contact_settings.h"
#include "dynamics/integration/method.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::forest {

/// `beam`: k = E I / l, bar inertia (E13). `paper`: k ~ d^2 / l, m ~ l d^2.
enum class Material : int { BEAM = 0, PAPER = 1 };
/// Selects the torque that fades out after promotion: all that keeps the procedural motion (E1), or
/// only its inertial part, as printed.
enum class WindForcing : int { COMPENSATED = 0, PAPER = 1 };
/// Selects the branches that become physical: those that the load deflects (N12), or all down to
/// the depth of the loaded one (S1-43).
enum class Promotion : int { INFLUENCE = 0, DEPTH = 1 };

/// Selects how the default, the midpoint rule of full chains, is computed: many joints at once in
/// single precision, or one by one in double precision as a reference. All other methods use double
/// precision.
enum class Precision : int { SINGLE = 0, DOUBLE = 1 };

/// A longer time between ticks is not stepped through.
constexpr Nanoseconds LONGEST_GAP = NANOSECONDS_PER_SECOND;

/// Which branches become physical, and how they are stepped.
struct PhysicsSettings {
  physics::Dynamics dynamics{physics::Dynamics::ARTICULATED};
  physics::Integrator integrator{physics::Integrator::MIDPOINT};
  Precision precision{Precision::SINGLE};
  Material material{Material::BEAM};
  WindForcing wind_forcing{WindForcing::COMPENSATED};
  Promotion promotion{Promotion::INFLUENCE};
  double influence_tolerance{0.005};  ///< branches that a load moves less stay procedural [m]
  int most_branches{20000};           ///< maximum number of physical branches in all trees
  double fade{0.5};                   ///< from the procedural load to the real one [s]
  double linger{4.0};                 ///< longest wait for a released branch to calm down [s]
  double blend{1.5};                  ///< from physical to procedural (S1-37) [s]
  physics::ContactLaw contact;        ///< between bodies and branches
};
void describe(FieldVisitor& visitor, PhysicsSettings& settings);

}  // namespace vegetation_sim::forest
