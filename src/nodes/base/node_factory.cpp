// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_factory.h"

#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "nodes/base/freed_memory.h"

namespace vegetation_sim {

int runNode(int argc, char** argv, const char* name, NodeFactory& create) {
  limitFreedMemory();
  ros::init(argc, argv, name);
  ros::NodeHandle handle, private_handle("~");  // must outlive the log message
  try {
    const std::shared_ptr<void> node = create(handle, private_handle);
    ros::spin();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    ROS_FATAL("%s refuses to start:\n%s", name, error.what());
    return EXIT_FAILURE;
  }
}

}  // namespace vegetation_sim
