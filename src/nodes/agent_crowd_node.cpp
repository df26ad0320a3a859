// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/agent_crowd.h"
#include "vegetation_sim/nodes/run_node.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::AgentCrowd>(argc, argv, "agent_crowd");
}
