// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::wind {

enum class Kind { DISK, BREEZE, GUST, TORNADO, BLAST };

/// "disk", "breeze", "gust", "tornado", "blast", in the order of Kind.
const std::vector<std::string>& kindNames();

/// Profile of a disk over the distance d from its centre.
enum class Envelope {
  SMOOTH,  ///< C2 (E1)
  PAPER,   ///< (r - d) / r as printed
};

/// Where the centre of a primitive is at a stamp.
struct Waypoint {
  Nanoseconds stamp{0};
  Vec3 position{Vec3::Zero()};  ///< [m], world
};

/// One immutable source of air motion (paper 1, section 4.1; paper 2, section 4.1). Once published
/// it never changes: an edit ends it and starts another a little ahead in time, so the past stays
/// what it was. docs/wind.md has the law of each kind.
struct Primitive {
  std::uint32_t id{0};  ///< unique in a field
  std::string name;     ///< handle of the user, shared by the successive edits of one source
  Kind kind{Kind::DISK};
  Nanoseconds epoch{0};  ///< zero of the phase, of the orbit and of `repeat`
  Nanoseconds t_on{0};   ///< start of the fade in
  Nanoseconds t_off{0};  ///< end of the fade out; 0 = for ever
  double fade_in{1.0};   ///< [s]
  double fade_out{1.0};  ///< [s]
  /// C2 through the points (natural cubic spline), straight on beyond them. Empty: at the origin.
  std::vector<Waypoint> trajectory;
  double orbit_radius{0.0};   ///< [m] circle that the centre runs around its trajectory
  double orbit_period{60.0};  ///< [s] counter-clockwise
  double repeat{0.0};         ///< gust: passes again each so many seconds; 0 = once [s]

  Vec3 velocity{Vec3(5.0, 0.0, 0.0)};   ///< amplitude (disk), mean (breeze), peak (gust) [m/s]
  double radius{10.0};                  ///< of influence; gust: half width; breeze: unused [m]
  double omega{2.0};                    ///< disk: pulsation [rad/s]
  double phase{0.0};                    ///< disk: phase psi [rad] (S1-16)
  Envelope envelope{Envelope::SMOOTH};  ///< disk
  double turbulence{0.2};               ///< breeze: rms of the along-wind fluctuation / mean speed
  double length_scale{40.0};            ///< breeze: integral length of the turbulence [m]
  double front_speed{6.0};      ///< gust: speed at which the front moves along `velocity` [m/s]
  double rise_length{5.0};      ///< gust: front from nothing to full [m]
  double plateau_length{10.0};  ///< gust: full strength behind the front [m]
  double decay_length{25.0};    ///< gust: from full to nothing behind the plateau [m]
  double speed{10.0};           ///< tornado: peak tangential; blast: peak outflow [m/s]
  double core_radius{2.0};      ///< tornado, blast: where the speed peaks [m]
  double inflow{0.3};           ///< tornado: towards the axis / tangential
  double updraft{0.2};          ///< tornado: upwards / tangential
};

/// Declares the numeric fields of `p` that its kind uses (not stamps, name or trajectory).
void describe(FieldVisitor& visitor, Primitive& p);

/// All faults of one primitive: numbers, finite way points in increasing order, t_off after t_on.
void check(Primitive primitive, Faults& faults);

}  // namespace vegetation_sim::wind
