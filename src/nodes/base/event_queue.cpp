// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/event_queue.h"

#include <ros/console.h>

#include "ros/services/diagnostics.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {

void warnOfLosses(diagnostic_updater::DiagnosticStatusWrapper& status, const QueueLosses& now,
                  const QueueLosses& reported) {
  warnOfMore(status, now.lost, reported.lost, "inputs lost, too many at once");
  warnOfMore(status, now.late, reported.late, "recorded events late, the replay differs");
}

void LossWarnings::warn(const char* node, const QueueLosses& losses) {
  if (losses.late > known_.late && late_.hasPassed())
    ROS_WARN(
        "%s: recorded events came after their tick, so this replay differs from its run; a larger "
        "replay_delay or a slower bag may help",
        node);
  if (losses.lost > known_.lost && lost_.hasPassed())
    ROS_WARN("%s: too many inputs at once; some are lost", node);
  known_ = losses;
}

void requireShare(const std::string& what, std::size_t own, std::size_t more, std::size_t share) {
  if (own + more > share)
    throw InvalidInput(what + " = " + std::to_string(own + more) + " with the " +
                           std::to_string(more) + " of this request, allowed are 0 to " +
                           std::to_string(share),
                       FaultCode::NO_ROOM);
}

}  // namespace vegetation_sim
