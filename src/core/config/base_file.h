// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "vegetation_sim/core/config/yaml.h"

namespace vegetation_sim {

/// Reads NAME.yaml in `folder` by `read` if the key `base` of a map has that NAME: small letters,
/// digits and underscores. Other keys of the map may then replace what was read. Faults of the file
/// become faults of the map.
void readBase(YamlSection& map, const std::string& folder,
              const std::function<void(YamlSection&)>& read);

}  // namespace vegetation_sim
