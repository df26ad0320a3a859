// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/budget_status_source.h"

#include <boost/bind/bind.hpp>
#include <utility>

namespace vegetation_sim::view {
namespace {

constexpr double MISSED = 5.0;  // [s]; diagnostics come each second

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.npos, end) == 0;
}

std::string valueOf(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key) {
  for (const diagnostic_msgs::KeyValue& value : status.values)
    if (value.key == key) return value.value;
  return "-";
}

// Returns the unit in brackets, "points" for "Budget [points]".
std::string unitOf(const std::string& key) {
  const std::size_t open = key.find('['), close = key.find(']');
  return close == key.npos ? std::string() : " " + key.substr(open + 1, close - open - 1);
}

}  // namespace

GovernorSource::GovernorSource(ros::NodeHandle nh, GovernorKeys keys)
    : keys_(std::move(keys)),
      subscriber_(nh.subscribe("/diagnostics", 10, &GovernorSource::take, this)) {}

void GovernorSource::take(const diagnostic_msgs::DiagnosticArray& message) {
  for (const diagnostic_msgs::DiagnosticStatus& status : message.status) {
    if (!endsWith(status.name, keys_.node + ": governor")) continue;
    text_ = status.message + ": " + valueOf(status, keys_.cost) + " of " +
            valueOf(status, keys_.budget) + unitOf(keys_.budget) + ", errors up to " +
            valueOf(status, "Largest predicted error [pixel]") + " pixel of " +
            valueOf(status, "Tolerance [pixel]");
    fresh_ = true;
  }
}

std::optional<InputStatus> GovernorSource::status(double wall) {
  if (text_.empty()) return {};
  if (std::exchange(fresh_, false)) received_ = wall;
  if (wall - received_ > MISSED) return InputStatus{false, "Not heard for 5 s; last: " + text_};
  return InputStatus{true, text_};
}

}  // namespace vegetation_sim::view
