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

enum class Kind { DISK, BREEZE, GUST, TORNADO, BLAST, WAKE, GAUSS_MARKOV };

/// Returns "disk", "breeze", "gust", "tornado", "blast", "wake", "gauss_markov", in the order of
/// Kind.
const std::vector<std::string>& kindNames();

/// Profile of a disk over the distance d from its centre.
enum class Envelope {
  SMOOTH,  ///< C2 (E1)
  PAPER,   ///< (r - d) / r as printed
};

/// The centre of a primitive at a stamp.
struct Waypoint {
  Nanoseconds stamp{0};
  Vec3 position{Vec3::Zero()};  ///< [m], world
};

/// One immutable source of wind (paper 1, section 4.1; paper 2, section 4.1). Once published it
/// never changes: an edit ends it and starts another a little ahead in time, so the past stays as
/// it was. docs/wind.md has the law of each kind.
struct Primitive {
  std::uint32_t id{0};  ///< unique in a field
  std::string name;     ///< name that the user gives, shared by the successive edits of one source
  Kind kind{Kind::DISK};
  Nanoseconds epoch{0};  ///< zero of the phase, of the orbit and of `repeat`
  Nanoseconds t_on{0};   ///< start of the fade in
  Nanoseconds t_off{0};  ///< end of the fade out; 0 = never
  double fade_in{1.0};   ///< [s]
  double fade_out{1.0};  ///< [s]
  /// C2 through the points (natural cubic spline), straight on beyond them. An empty one stays at
  /// the origin.
  std::vector<Waypoint> trajectory;
  double orbit_radius{0.0};   ///< [m] circle that the centre describes around its trajectory
  double orbit_period{60.0};  ///< [s] counter-clockwise
  double repeat{0.0};         ///< gust: period of repetition; 0 = once [s]

  /// amplitude (disk), mean (breeze, Gauss-Markov), peak (gust) [m/s]
  Vec3 velocity{Vec3(5.0, 0.0, 0.0)};
  /// radius of influence; gust: half width; wake: radius of the body; breeze: unused [m]
  double radius{10.0};
  double omega{2.0};                    ///< disk: angular frequency [rad/s]
  double phase{0.0};                    ///< disk: phase psi [rad] (S1-16)
  Envelope envelope{Envelope::SMOOTH};  ///< disk
  /// breeze, Gauss-Markov: rms of the along-wind fluctuation / mean speed
  double turbulence{0.2};
  double time_scale{5.0};     ///< Gauss-Markov: the autocorrelation is exp(-|t| / it) [s]
  double length_scale{40.0};  ///< breeze: integral length of the turbulence [m]
  double front_speed{6.0};    ///< gust: speed at which the front moves along `velocity` [m/s]
  double rise_length{5.0};    ///< gust: length of the front, from nothing to full strength [m]
  /// gust: length at full strength behind the front; wake: length behind the centre that follows
  /// the law of momentum [m]
  double plateau_length{10.0};
  /// gust, wake: length from there to nothing [m]
  double decay_length{25.0};
  double speed{10.0};       ///< tornado: peak tangential speed; blast: peak outflow [m/s]
  double core_radius{2.0};  ///< tornado, blast: radius of the peak speed [m]
  /// tornado: speed towards the axis / tangential speed; wake: speed of the air that flows into the
  /// place of the body / speed of the body
  double inflow{0.3};
  double updraft{0.2};  ///< tornado: upward speed / tangential speed
};

/// Declares the numeric fields of `p` that its kind uses (not stamps, name or trajectory).
void describe(FieldVisitor& visitor, Primitive& p);

/// Adds all faults of one primitive: numbers, way points that are not finite or not increasing in
/// time, t_off not after t_on.
void check(Primitive primitive, Faults& faults);

}  // namespace vegetation_sim::wind
