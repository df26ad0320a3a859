// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/run_node.h"
#include "nodes/crowd/agent_crowd.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::AgentCrowd>(argc, argv, "agent_crowd");
}
