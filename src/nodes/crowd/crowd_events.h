// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/CrowdEvent.h>

#include "crowd/agents/crowd.h"

namespace vegetation_sim {

/// Applies an event about a walker or a robot. @throws InvalidInput, and then nothing has changed,
/// also for another kind.
void applyToCrowd(const CrowdEvent& event, crowd::Crowd& crowd);

}  // namespace vegetation_sim
