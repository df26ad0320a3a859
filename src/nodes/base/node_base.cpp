// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_base.h"

namespace vegetation_sim {

NodeBase::NodeBase(const std::string& name, const ros::NodeHandle& handle,
                   const ros::NodeHandle& private_handle)
    : name_(name),
      handle_(handle),
      private_handle_(private_handle),
      refusals_(name),
      diagnostics_(handle, private_handle, private_handle.getNamespace()) {
  diagnostics_.setHardwareID("none");
}

void NodeBase::startDiagnostics() {
  diagnostics_timer_ = handle_.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
}

void NodeBase::openServices() {
  open_ = true;
  for (const auto& advertise : closed_) services_.push_back(advertise());
  closed_.clear();
}

void NodeBase::stopCallbacks() {
  diagnostics_timer_.stop();
  timers_.clear();
  services_.clear();
  subscribers_.clear();
}

}  // namespace vegetation_sim
