// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "vegetation_sim/nodes/wind_broadcaster.h"

namespace vegetation_sim {

/// wind_broadcaster inside a nodelet manager, which does not load it if it refuses to start.
class WindBroadcasterNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<WindBroadcaster>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("wind_broadcaster refuses to start:\n%s", error.what());
      throw;
    }
  }
  std::unique_ptr<WindBroadcaster> node_;
};

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::WindBroadcasterNodelet, nodelet::Nodelet)
