// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "crowd/agents/decision.h"

namespace vegetation_sim::crowd {

/// Decides by the law of paper 2, section 5.2 (S2-32): the nearer the nearest obstacle, the slower
/// the walker and the more it turns away from it. It turns right before an obstacle straight ahead.
Command decideByPaper(const Walker& walker, const View& view, const CrowdSettings& settings,
                      const Wish& wish, Nanoseconds stamp);

}  // namespace vegetation_sim::crowd
