// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>

#include "vegetation_sim/common/faults.h"
#include "vegetation_sim/nodes/vegetation_scanner.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "vegetation_scanner");
  ros::NodeHandle handle, private_handle("~");  // out here, since the last one closes the log
  try {
    vegetation_sim::VegetationScanner node(handle, private_handle);
    ros::spin();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("vegetation_scanner refuses to start:\n%s", error.what());
    return EXIT_FAILURE;
  }
}
