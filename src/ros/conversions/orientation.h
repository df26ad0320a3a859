// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Quaternion.h>

#include <string>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// The orientation of an input, by one rule for all: its norm is 0.99 to 1.01, else a fault is
/// added; it is normalised unless it is a unit quaternion but for rounding, which keeps its bits.
Quat orientationOf(const geometry_msgs::Quaternion& q, const std::string& name, Faults& faults);

}  // namespace vegetation_sim
