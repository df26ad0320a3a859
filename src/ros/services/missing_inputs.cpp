// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/services/missing_inputs.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <ros/console.h>

#include <algorithm>

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_NAMED = 5;  // in a status that people read

}  // namespace

std::string describeMissingTransform(const std::string& frame, const std::string& world) {
  return "no transform from '" + frame + "' to '" + world + "'";
}

void MissingInputs::add(const std::string& sentence) {
  if (std::find(missing_.begin(), missing_.end(), sentence) == missing_.end())
    missing_.push_back(sentence);
}

void MissingInputs::warn(const std::string& node,
                         diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::string text;
  for (std::size_t i = 0; i < missing_.size(); ++i) {
    if (i < MOST_NAMED) text += (i ? "; " : "") + missing_[i];
    if (!logged_.count(missing_[i])) ROS_WARN("%s: %s", node.c_str(), missing_[i].c_str());
  }
  if (missing_.size() > MOST_NAMED)
    text += "; and " + std::to_string(missing_.size() - MOST_NAMED) + " more";
  logged_ = {missing_.begin(), missing_.end()};
  if (!text.empty()) status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, text);
}

}  // namespace vegetation_sim
