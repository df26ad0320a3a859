// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/run_node.h"
#include "nodes/grass/grass_field.h"

int main(int argc, char** argv) {
  return vegetation_sim::runNode<vegetation_sim::GrassField>(argc, argv, "grass_field");
}
