// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_base.h"

#include "ros/services/rivals.h"

namespace vegetation_sim {
namespace {

ros::NodeHandle handleOf(ros::NodeHandle handle, ClosableQueue& callbacks) {
  handle.setCallbackQueue(&callbacks);
  return handle;
}

}  // namespace

NodeBase::NodeBase(const std::string& name, const ros::NodeHandle& handle,
                   const ros::NodeHandle& private_handle)
    : name_(name),
      callbacks_(makeClosableQueue(*handle.getCallbackQueue())),
      handle_(handleOf(handle, callbacks_)),
      private_handle_(handleOf(private_handle, callbacks_)),
      refusals_(name),
      diagnostics_(handle_, private_handle_, private_handle.getNamespace()) {
  diagnostics_.setHardwareID("none");
}

void NodeBase::startDiagnostics() {
  diagnostics_timer_ =
      handle_.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) {
        acceptInput("diagnostics", [this] { diagnostics_.force_update(); });
      });
}

void NodeBase::openServices() {
  open_ = true;
  for (const auto& advertise : closed_) services_.push_back(advertise());
  closed_.clear();
}

void NodeBase::stopCallbacks() {
  callbacks_.close();
  diagnostics_timer_.stop();
  timers_.clear();
  services_.clear();
  owned_.clear();
  subscribers_.clear();
}

void NodeBase::warnOfRivals(Status& status) const {
  const std::string rivals = describeRivals(owned_);
  if (!rivals.empty())
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN,
                        rivals + ": the last message wins");
}

}  // namespace vegetation_sim
