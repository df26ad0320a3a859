// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/run_node.h"
#include "vegetation_sim/nodes/vegetation_scanner.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::VegetationScanner>(argc, argv,
                                                                    "vegetation_scanner");
}
