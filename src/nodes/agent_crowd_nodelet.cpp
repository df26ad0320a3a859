// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "vegetation_sim/nodes/agent_crowd.h"

namespace vegetation_sim {

/// agent_crowd inside a nodelet manager, which does not load it if it refuses to start.
class AgentCrowdNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<AgentCrowd>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("agent_crowd refuses to start:\n%s", error.what());
      throw;
    }
  }
  std::unique_ptr<AgentCrowd> node_;
};

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::AgentCrowdNodelet, nodelet::Nodelet)
