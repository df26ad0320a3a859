// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>

#include "vegetation_sim/nodes/vegetation_scanner.h"

namespace vegetation_sim {

/// vegetation_scanner inside a nodelet manager, which does not load it if it refuses to start.
class VegetationScannerNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<VegetationScanner>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL("vegetation_scanner refuses to start:\n%s", error.what());
      throw;
    }
  }
  std::unique_ptr<VegetationScanner> node_;
};

}  // namespace vegetation_sim

PLUGINLIB_EXPORT_CLASS(vegetation_sim::VegetationScannerNodelet, nodelet::Nodelet)
