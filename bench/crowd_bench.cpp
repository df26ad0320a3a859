// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures walkers: distances of convex shapes, cost of a step of a crowd,
// ways among walls, outcome of experiments.
// usage: crowd_bench [queries [COUNT] | scale | goals [SECONDS] | behaviour [SEEDS]]
// Runs all parts if none is named.
#include <cstdlib>
#include <string>

#include "crowd/sections.h"

int main(int argc, char** argv) {
  namespace bench = vegetation_sim::crowd::bench;
  const std::string part = argc > 1 ? argv[1] : "all";
  const double number = argc > 2 ? std::atof(argv[2]) : 0.0;
  if (part == "all" || part == "queries") bench::benchQueries(number > 0.0 ? number : 1e7, 15);
  if (part == "all" || part == "scale") bench::benchScale(9);
  if (part == "all" || part == "goals") bench::benchGoals(number > 0.0 ? number : 20.0);
  if (part == "all" || part == "behaviour")
    bench::benchBehaviour(number > 0.0 ? static_cast<int>(number) : 20);
  return 0;
}
