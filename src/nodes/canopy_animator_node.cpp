// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/canopy_animator.h"
#include "vegetation_sim/nodes/run_node.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::CanopyAnimator>(argc, argv, "canopy_animator");
}
