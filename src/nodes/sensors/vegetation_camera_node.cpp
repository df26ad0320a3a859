// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/run_node.h"
#include "nodes/sensors/vegetation_camera.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::VegetationCamera>(argc, argv, "vegetation_camera");
}
