// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/node_factory.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode(argc, argv, "vegetation_camera",
                                 vegetation_sim::createVegetationCamera);
}
