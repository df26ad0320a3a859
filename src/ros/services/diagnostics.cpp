// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>

#include <algorithm>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr int MOST_LINES = 5;  // of a status that people read

std::string beginningOf(const std::string& all) {
  const std::string text = shortened(all, LONGEST_ERROR);
  std::size_t end = 0;
  for (int line = 0; line < MOST_LINES; ++line) {
    end = text.find('\n', end + (line > 0 ? 1 : 0));
    if (end == std::string::npos) return text;
  }
  const auto rest = text.begin() + static_cast<std::ptrdiff_t>(end);
  return text.substr(0, end) + "\nand " + std::to_string(std::count(rest, text.end(), '\n')) +
         " more";
}

}  // namespace

void warnOfMore(diagnostic_updater::DiagnosticStatusWrapper& status, std::uint64_t now,
                std::uint64_t reported, const std::string& what) {
  if (now > reported)
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        std::to_string(now - reported) + " " + beginningOf(what));
}

void warnOfClock(diagnostic_updater::DiagnosticStatusWrapper& status, const TickClock::Counts& now,
                 const TickClock::Counts& reported) {
  warnOfMore(status, now.dropped, reported.dropped, "ticks dropped");
  warnOfMore(status, now.jumps, reported.jumps, "jumps back of the clock");
}

void Refusals::add(const std::string& what, const std::string& why) {
  ++count_;
  last_ = shortened(what + ": " + why, LONGEST_ERROR);
  const ros::WallTime now = ros::WallTime::now();
  if (now < quiet_until_) return;
  quiet_until_ = now + ros::WallDuration(1.0);
  ROS_WARN("%s: refused %s", node_.c_str(), last_.c_str());
}

void Refusals::warn(diagnostic_updater::DiagnosticStatusWrapper& status) {
  warnOfMore(status, count_, reported_, std::string("refused ") + kind_ + ": " + last_);
  reported_ = count_;
}

}  // namespace vegetation_sim
