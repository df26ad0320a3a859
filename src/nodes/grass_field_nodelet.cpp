// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "vegetation_sim/nodes/grass_field.h"

namespace vegetation_sim {

/// grass_field inside a nodelet manager, which does not load it if it refuses to start.
class GrassFieldNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<GrassField>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("grass_field refuses to start:\n%s", error.what());
      throw;
    }
  }
  std::unique_ptr<GrassField> node_;
};

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::GrassFieldNodelet, nodelet::Nodelet)
