// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "vegetation_sim/wind/primitive.h"

namespace vegetation_sim::wind {

constexpr std::size_t MAX_PRIMITIVES =
    256;  ///< in a field, ended ones that are still kept included
constexpr std::size_t MAX_WAYPOINTS = 4096;  ///< of one primitive
constexpr std::size_t MAX_NAME = 128;        ///< [characters]
/// Last stamp that a ROS time can hold.
constexpr Nanoseconds LAST_STAMP = 4294967295LL * NANOSECONDS_PER_SECOND;

constexpr double SHORTEST_ORBIT = 0.1;  ///< [s] shortest period of an orbit
/// An edit of a source waits for the change before it at most this long, else it is rejected [ns].
constexpr Nanoseconds LONGEST_WAIT = 30 * NANOSECONDS_PER_SECOND;
constexpr Range SPEEDS{-200.0, 200.0};  ///< [m/s] each component
/// [m/s] horizontal, of the body of a wake; a faster step of a followed frame is a jump
constexpr Range BODY_SPEEDS{0.0, 200.0};
constexpr Range POSITIONS{-1e6, 1e6};     ///< [m] each component
constexpr Range TURBULENCE{0.0, 1.0};     ///< rms / mean
constexpr Range TIME_SCALES{0.1, 600.0};  ///< [s] of a Gauss-Markov wind

/// Returns the horizontal speed between way points [m/s]; infinite or NaN for equal stamps.
double levelSpeed(const Waypoint& from, const Waypoint& to);

/// Declares every numeric field, used by its kind or not: for hashes.
void describeAll(FieldVisitor& visitor, Primitive& p);

}  // namespace vegetation_sim::wind
