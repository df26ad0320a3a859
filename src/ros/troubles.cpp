// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/troubles.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

namespace vegetation_sim {

void warnOfMore(diagnostic_updater::DiagnosticStatusWrapper& status, std::uint64_t now,
                std::uint64_t reported, const std::string& what) {
  if (now > reported)
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        std::to_string(now - reported) + " " + what);
}

void warnOfClock(diagnostic_updater::DiagnosticStatusWrapper& status, const TickClock::Counts& now,
                 const TickClock::Counts& reported) {
  warnOfMore(status, now.dropped, reported.dropped, "ticks dropped");
  warnOfMore(status, now.jumps, reported.jumps, "jumps back of the clock");
}

}  // namespace vegetation_sim
