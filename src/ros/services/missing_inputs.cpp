// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/missing_inputs.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_NAMED = 5;  // in a status that people read
// Warnings before the line on the console, since frames come one by one at a start.
constexpr int UNLOGGED = 2;

}  // namespace

std::string describeMissingTransform(const std::string& frame, const std::string& world) {
  return "no transform from " + inQuotes(frame) + " to " + inQuotes(world);
}

void MissingInputs::add(const std::string& sentence) {
  if (std::find(missing_.begin(), missing_.end(), sentence) == missing_.end())
    missing_.push_back(sentence);
}

void MissingInputs::warn(const std::string& node,
                         diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::string text;
  std::map<std::string, int> warnings;
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    if (i < MOST_NAMED) text += (i ? "; " : "") + missing_[i];
    const int before = warnings_[missing_[i]];
    if (before == UNLOGGED) ROS_WARN("%s: %s", node.c_str(), missing_[i].c_str());
    warnings[missing_[i]] = before + 1;
  }
  if (missing_.size() > MOST_NAMED)
    text += "; and " + std::to_string(missing_.size() - MOST_NAMED) + " more";
  warnings_ = std::move(warnings);
  if (!text.empty()) status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, text);
}

}  // namespace vegetation_sim
