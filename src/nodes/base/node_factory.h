// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

namespace vegetation_sim {

/// Creates a node, which runs as long as it exists. The programs and nodelets know no more of it,
/// so that only its own sources compile its class. @throws InvalidInput for invalid parameters or
/// an invalid scenario.
using NodeFactory = std::shared_ptr<void>(const ros::NodeHandle& handle,
                                          const ros::NodeHandle& private_handle);
NodeFactory createAgentCrowd;
NodeFactory createCanopyAnimator;
NodeFactory createForestAnimator;
NodeFactory createGrassField;
NodeFactory createVegetationCamera;
NodeFactory createVegetationScanner;
NodeFactory createWindBroadcaster;

/// Runs a node until ROS shuts down, and returns the exit code. An exception of its constructor is
/// logged as fatal.
int runNode(int argc, char** argv, const char* name, NodeFactory& create);

}  // namespace vegetation_sim
