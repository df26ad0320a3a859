// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures a tick of a forest whose branches are all physical, in a breeze of 24 modes at 60 Hz:
// processor time per branch and tick, while nothing acts on the trees and while a hand holds each;
// and the search for trees near bodies. thread_bench measures several threads.
// usage: forest_physics_bench [ROUNDS] [--quick] [--part free,held,bodies] [--csv FILE]
#include <cstdio>

#include "options.h"
#include "processor_time.h"
#include "scenes/forest/physical_forest.h"
#include "table.h"
#include "tree/growth/tree_grid.h"

namespace vegetation_sim::forest {
namespace {

using bench::Options;

constexpr double SAMPLED_BRANCHES = 4e5;  // branches and ticks of one round

void report(const char* load, PhysicalForest& forest, int rounds, bench::Table& table) {
  const auto branches = static_cast<double>(forest.branchCount());
  const int ticks = std::max(1, static_cast<int>(SAMPLED_BRANCHES / branches));
  std::vector<bench::Candidate> ticking{{load, [&] {
                                           for (int i = 0; i < ticks; ++i) forest.advance();
                                         }}};
  bench::timeOnProcessor(ticking, rounds);
  const double each = 1e9 / (branches * ticks);
  std::printf("%-6s %6u %9.0f %10.1f %10.1f   %016llx\n", load, forest.treeCount(), branches,
              each * ticking[0].seconds, each * ticking[0].least,
              static_cast<unsigned long long>(forest.hash()));
  table.row(std::string(load) + ", " + std::to_string(forest.treeCount()) + " trees", branches,
            ticking[0].seconds / ticks);
}

void benchForests(const Options& options, bench::Table& table) {
  std::printf("A tick at 60 Hz in a breeze, all branches physical: ns per branch, state\n");
  std::printf("%-6s %6s %9s %10s %10s\n", "load", "trees", "branches", "median", "least");
  const std::vector<std::size_t> totals = options.quick
                                              ? std::vector<std::size_t>{5000}
                                              : std::vector<std::size_t>{5000, 40000, 100000};
  for (const std::size_t branches : {256u, 6000u})
    for (const std::size_t total : totals) {
      PhysicalForest forest(branches, total);
      if (options.wants("free")) report("free", forest, options.rounds, table);
      if (!options.wants("held")) continue;
      forest.hold();
      report("held", forest, options.rounds, table);
    }
}

// The bodies are between trees, so that only the search is measured.
void benchBodies(const Options& options) {
  std::printf("\nTrees near 15 bodies: trees, us with a comparison with all, us with the grid\n");
  const terrain::HeightMap flat;
  for (const int side : options.quick ? std::vector<int>{100} : std::vector<int>{316, 1000}) {
    const Layout layout = gridLayout(side, 40.0);
    const TreeGrid grid(layout);
    std::size_t found = 0;
    const auto search = [&](const TreeGrid* with) {
      for (int body = 0; body < 15; ++body) {
        const Vec3 centre(40.0 * body + 60.0, 40.0 * side / 2 + 20.0, 1.0);
        found += findTreesNear(layout, with, flat, centre, 0.5).size();
      }
    };
    std::vector<bench::Candidate> candidates{{"all", [&] { search(nullptr); }},
                                             {"grid", [&] { search(&grid); }}};
    bench::timeOnProcessor(candidates, options.rounds);
    std::printf("%8d %12.1f %8.1f   %zu found\n", side * side, 1e6 * candidates[0].seconds,
                1e6 * candidates[1].seconds, found);
  }
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    const bench::Options options = bench::readOptions(argc, argv, {"free", "held", "bodies"});
    bench::Table table(options.csv, bench::SIZE_COLUMNS);
    if (options.wants("free") || options.wants("held")) forest::benchForests(options, table);
    if (options.wants("bodies")) forest::benchBodies(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forest_physics_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
