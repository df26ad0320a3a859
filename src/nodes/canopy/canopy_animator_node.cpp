// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/run_node.h"
#include "nodes/canopy/canopy_animator.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::CanopyAnimator>(argc, argv, "canopy_animator");
}
