// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/PlantContacts.h>

#include <string>
#include <vector>

#include "nodes/bodies/robot_bodies.h"
#include "ros/replicas/subscribed_crowd.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {

/// Prefix of the ids of walkers among the bodies.
constexpr const char* WALKER_PREFIX = "walker_";

/// Returns the upright capsule of a walker.
forest::Body bodyOf(const SubscribedCrowd::Person& person, Nanoseconds stamp);

/// Returns how the walkers near plants differ from those known. @param now time of the tick; a
/// message whose stamp differs from it by more than STALE_BODY counts as none. @param left_out
/// number of walkers beyond the limit of bodies.
std::vector<BodyChange> changesOfWalkers(const canopy::Canopy& canopy, const SubscribedCrowd& crowd,
                                         Nanoseconds now, std::size_t& left_out);

/// Returns the forces of plants on bodies at the last tick; the sender adds the header's frame.
PlantContacts contactsOf(const canopy::Canopy& canopy);

}  // namespace vegetation_sim
