// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display.h>

#include <map>
#include <string>

#include "ros/replicas/input_status.h"

namespace vegetation_sim::view {

/// Status lines of a display. They are set only when they change, since Qt redraws its tree.
class StatusBoard {
 public:
  explicit StatusBoard(rviz::Display& display) : display_(display) {}

  void show(rviz::StatusProperty::Level level, const std::string& name, const std::string& text);
  void show(const std::string& name, const InputStatus& status);
  void forget() { shown_.clear(); }

 private:
  rviz::Display& display_;
  std::map<std::string, std::string> shown_;
};

}  // namespace vegetation_sim::view
