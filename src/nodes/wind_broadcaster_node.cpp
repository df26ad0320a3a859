// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>

#include "vegetation_sim/nodes/wind_broadcaster.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "wind_broadcaster");
  ros::NodeHandle nh, private_nh("~");  // out here, since the last one closes the log
  try {
    vegetation_sim::WindBroadcaster node(nh, private_nh);
    ros::spin();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("wind_broadcaster refuses to start:\n%s", error.what());
    return EXIT_FAILURE;
  }
}
