// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/wind/source.h"

namespace vegetation_sim::wind {

/// Reads the section `wind` of a scenario: `seed` and the list `primitives`, with the keys of
/// docs/wind.md. Stamps count from 0, the start of the node; startedAt() shifts them. Faults are
/// added to the section's list.
std::vector<Source> readWind(YamlSection& section, std::uint64_t& seed);

}  // namespace vegetation_sim::wind
