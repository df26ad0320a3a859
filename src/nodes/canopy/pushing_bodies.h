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

/// Returns the people of a crowd as upright capsules.
std::vector<forest::Body> bodiesOf(const SubscribedCrowd& crowd);

/// Returns how the bodies near plants differ from those that the canopy knows: first those that are
/// gone, then the others in the order of `present`. @param left_out number of bodies beyond
/// MOST_PUSHING.
std::vector<BodyChange> changesNearPlants(const canopy::Canopy& canopy,
                                          const std::vector<forest::Body>& present,
                                          std::size_t& left_out);

/// Returns the forces of plants on bodies at the last tick; the sender adds the header's frame.
PlantContacts contactsOf(const canopy::Canopy& canopy);

}  // namespace vegetation_sim
