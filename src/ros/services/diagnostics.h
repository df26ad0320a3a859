// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/time.h>

#include <cstdint>
#include <string>
#include <utility>

#include "ros/time/tick_clock.h"

namespace vegetation_sim {

/// Warns on /diagnostics of events since the last report. A text of many lines is cut, with the
/// number of lines left out, and a long one as errors are.
void warnOfMore(diagnostic_updater::DiagnosticStatusWrapper& status, std::uint64_t now,
                std::uint64_t reported, const std::string& what);
void warnOfClock(diagnostic_updater::DiagnosticStatusWrapper& status, const TickClock::Counts& now,
                 const TickClock::Counts& reported);

/// Rejected inputs or requests of a node, reported on the console at most once a second and on
/// /diagnostics.
class Refusals {
 public:
  /// @param kind what is refused, in the warning.
  explicit Refusals(std::string node, const char* kind = "input")
      : node_(std::move(node)), kind_(kind) {}

  void add(const std::string& what, const std::string& why);
  /// Warns of those since the last warning, with the reason for the last one.
  void warn(diagnostic_updater::DiagnosticStatusWrapper& status);
  std::uint64_t count() const { return count_; }
  const std::string& last() const { return last_; }

 private:
  std::string node_;
  const char* kind_;
  std::string last_;
  std::uint64_t count_{0}, reported_{0};
  ros::WallTime quiet_until_;
};

}  // namespace vegetation_sim
