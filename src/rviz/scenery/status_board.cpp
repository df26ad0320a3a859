// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/status_board.h"

namespace vegetation_sim::view {

void StatusBoard::show(rviz::StatusProperty::Level level, const std::string& name,
                       const std::string& text) {
  std::string& shown = shown_[name];
  const std::string wanted = std::to_string(level) + text;
  if (shown == wanted) return;
  shown = wanted;
  display_.setStatusStd(level, name, text);
}

void StatusBoard::show(const std::string& name, const InputStatus& status) {
  show(status.good ? rviz::StatusProperty::Ok : rviz::StatusProperty::Warn, name, status.text);
}

}  // namespace vegetation_sim::view
