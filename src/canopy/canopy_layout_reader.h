// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/canopy/canopy_layout.h"

namespace vegetation_sim::canopy {

constexpr std::size_t MOST_KINDS = 256;  ///< of plants in a layout

/// Does the same as readLayout() without a folder; kinds may have a `base`, a file in the folder
/// `plants` beside `folder`, which is that of the scenario.
Layout readLayout(YamlSection section, const std::string& folder, const terrain::HeightMap& terrain,
                  std::uint64_t seed, Faults& faults);

}  // namespace vegetation_sim::canopy
