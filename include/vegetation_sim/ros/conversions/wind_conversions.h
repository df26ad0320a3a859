// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/WindField.h>
#include <vegetation_sim/WindPrimitive.h>

#include <string>

#include "vegetation_sim/wind/field.h"
#include "vegetation_sim/wind/source.h"

namespace vegetation_sim {

WindPrimitive toMsg(const wind::Primitive& primitive);
/// Converts without checks; the headers of the waypoints are ignored.
wind::Primitive fromMsg(const WindPrimitive& message);

/// Converts a request. Adds a fault for a waypoint in another frame than `frame_id` or none.
wind::Source sourceFromMsg(const WindPrimitive& message, const std::string& frame_id,
                           Faults& faults);

/// @param frame_id world frame; @param stamp of the header.
WindField toMsg(const wind::Field& field, const std::string& frame_id, Nanoseconds stamp);
/// @throws InvalidInput with all faults, and if the hash is another than the sender's.
wind::Field fromMsg(const WindField& message);

}  // namespace vegetation_sim
