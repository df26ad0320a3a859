// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "vegetation_sim/nodes/forest_animator.h"

namespace vegetation_sim {

/// forest_animator inside a nodelet manager, which does not load it if it refuses to start.
class ForestAnimatorNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<ForestAnimator>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("forest_animator refuses to start:\n%s", error.what());
      throw;
    }
  }
  std::unique_ptr<ForestAnimator> node_;
};

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::ForestAnimatorNodelet, nodelet::Nodelet)
