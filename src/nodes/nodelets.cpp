// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "nodes/canopy/canopy_animator.h"
#include "nodes/crowd/agent_crowd.h"
#include "nodes/forest/forest_animator.h"
#include "nodes/grass/grass_field.h"
#include "nodes/sensors/vegetation_camera.h"
#include "nodes/sensors/vegetation_scanner.h"
#include "nodes/wind/wind_broadcaster.h"

namespace vegetation_sim {
namespace {

/// A node inside a nodelet manager, which does not load it if its constructor throws.
template <class Node>
class NodeletOf : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("%s refuses to start:\n%s", getName().c_str(), error.what());
      throw;
    }
  }
  std::unique_ptr<Node> node_;
};

}  // namespace

using AgentCrowdNodelet = NodeletOf<AgentCrowd>;
using CanopyAnimatorNodelet = NodeletOf<CanopyAnimator>;
using ForestAnimatorNodelet = NodeletOf<ForestAnimator>;
using GrassFieldNodelet = NodeletOf<GrassField>;
using VegetationCameraNodelet = NodeletOf<VegetationCamera>;
using VegetationScannerNodelet = NodeletOf<VegetationScanner>;
using WindBroadcasterNodelet = NodeletOf<WindBroadcaster>;

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::AgentCrowdNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::CanopyAnimatorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::ForestAnimatorNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::GrassFieldNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::VegetationCameraNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::VegetationScannerNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(vegetation_sim::WindBroadcasterNodelet, nodelet::Nodelet)
