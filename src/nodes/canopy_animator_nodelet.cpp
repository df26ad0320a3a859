// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "vegetation_sim/nodes/canopy_animator.h"

namespace vegetation_sim {

/// canopy_animator inside a nodelet manager, which does not load it if it refuses to start.
class CanopyAnimatorNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<CanopyAnimator>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("canopy_animator refuses to start:\n%s", error.what());
      throw;
    }
  }
  std::unique_ptr<CanopyAnimator> node_;
};

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::CanopyAnimatorNodelet, nodelet::Nodelet)
