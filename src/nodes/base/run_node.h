// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <cstdlib>
#include <exception>

namespace vegetation_sim {

/// Runs a node until ROS shuts down. An exception of its constructor is logged as fatal.
template <class Node>
int runNode(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  ros::NodeHandle handle, private_handle("~");  // must outlive the log message
  try {
    Node node(handle, private_handle);
    ros::spin();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("%s refuses to start:\n%s", name, error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace vegetation_sim
