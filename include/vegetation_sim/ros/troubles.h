// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <cstdint>
#include <string>

#include "vegetation_sim/ros/tick_clock.h"

namespace vegetation_sim {

/// Warns on /diagnostics of what has happened since the last report, and only of that. Of text of
/// many lines the first few, and how many more.
void warnOfMore(diagnostic_updater::DiagnosticStatusWrapper& status, std::uint64_t now,
                std::uint64_t reported, const std::string& what);
void warnOfClock(diagnostic_updater::DiagnosticStatusWrapper& status, const TickClock::Counts& now,
                 const TickClock::Counts& reported);

}  // namespace vegetation_sim
