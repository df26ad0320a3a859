// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "nodes/base/node_factory.h"

namespace vegetation_sim {
namespace {

/// A node inside a nodelet manager, which does not load it if its constructor throws.
template <NodeFactory& create>
class NodeletOf : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = create(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("%s refuses to start:\n%s", getName().c_str(), error.what());
      throw;
    }
  }
  std::shared_ptr<void> node_;
};

}  // namespace

using AgentCrowdNodelet = NodeletOf<createAgentCrowd>;
using CanopyAnimatorNodelet = NodeletOf<createCanopyAnimator>;
using ForestAnimatorNodelet = NodeletOf<createForestAnimator>;
using GrassFieldNodelet = NodeletOf<createGrassField>;
using VegetationCameraNodelet = NodeletOf<createVegetationCamera>;
using VegetationScannerNodelet = NodeletOf<createVegetationScanner>;
using WindBroadcasterNodelet = NodeletOf<createWindBroadcaster>;

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::AgentCrowdNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::CanopyAnimatorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::ForestAnimatorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::GrassFieldNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::VegetationCameraNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::VegetationScannerNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::WindBroadcasterNodelet, nodelet::Nodelet)
