// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures a tick of a forest whose branches are all physical, in a breeze of 24 modes at 60 Hz:
// processor time per branch and tick, while nothing acts on the trees and while a hand holds each;
// wall time on several threads; and the search for trees near bodies.
// usage: forest_physics_bench [ROUNDS] [--quick] [--part free,held,threads,bodies] [--csv FILE]
#include <cstdio>

#include "options.h"
#include "processor_time.h"
#include "scenes/forest/forest_fixture.h"
#include "table.h"
#include "tree/growth/tree_grid.h"

namespace vegetation_sim::forest {
namespace {

using bench::Options;

constexpr Nanoseconds START = 1700000000LL * NANOSECONDS_PER_SECOND;
constexpr int RATE = 60;               // [Hz]
constexpr int PUSHED_AT_A_TIME = 200;  // trees
constexpr int MOST_HELD = 256;         // trees: there is a limit of grabs
constexpr int SETTLING_TICKS = RATE;
constexpr double SAMPLED_BRANCHES = 4e5;  // branches and ticks of one round

/// Oaks of so many branches or a few more, enough of them for `total` branches.
Layout oaks(std::size_t branches, std::size_t total) {
  Layout out;
  const Species plain = shippedSpecies("oak");
  TreeSeed seed;
  Design design;
  std::size_t grown = 0;
  for (design.children = 0.3; grown < branches; design.children *= 1.02) {
    out.species = {applyDesign(plain, design)};
    grown = grow(seed, out.species[0]).branches.size();
  }
  for (std::size_t sum = 0; sum < total; sum += grown) {
    const std::size_t i = out.trees.size();
    seed.position = Vec3(15.0 * static_cast<double>(i % 20), 15.0 * static_cast<double>(i / 20), 0);
    out.trees.push_back(seed);
  }
  return out;
}

/// A forest whose branches are physical and stay so.
class PhysicalForest {
 public:
  PhysicalForest(std::size_t branches, std::size_t total)
      : forest_(oaks(branches, total), flatTerrain(), Settings()), tick_(grid_.tickAt(START)) {
    PhysicsSettings physics;
    physics.promotion = Promotion::DEPTH;
    physics.influence_tolerance = 1e-6;
    physics.linger = 3600.0;
    physics.most_branches = 1000000;
    forest_.setPhysics(physics);
    wind::Primitive breeze = makeBreeze(1, Vec3(4.0, 2.0, 0.0));
    breeze.turbulence = 0.2;
    forest_.setWind(wind::Field({breeze}));
    forest_.advance(grid_.timeOf(tick_));
    twig_ = static_cast<int>(
                growTree(forest_.layout(), 0, forest_.terrain()).skeleton.branches.size()) -
            1;
    for (std::uint32_t tree = 0; tree < treeCount(); ++tree) {
      Push push;
      push.point = {tree, twig_, 0.0};
      push.until = grid_.timeOf(tick_ + 1);
      forest_.push(push);
      if (tree % PUSHED_AT_A_TIME == PUSHED_AT_A_TIME - 1) advance();
    }
    settle();
  }
  std::uint32_t treeCount() const { return forest_.layout().treeCount(); }
  std::size_t branchCount() const { return forest_.physicsFigures().branches; }
  /// Holds a twig of every tree.
  void hold() {
    for (std::uint32_t id = 0; id < treeCount() && id < MOST_HELD; ++id) {
      const Tree tree = growTree(forest_.layout(), id, forest_.terrain());
      const auto twig = static_cast<std::size_t>(twig_);
      Grab grab;
      grab.point = {id, twig_, 0.0};
      grab.target = tree.foot + forest_.pose(tree, id, forest_.snapshot().stamp)[twig].position;
      forest_.addGrab(grab);
    }
    settle();
  }
  /// Lets the fade after promotion end, in which steps cost several times as much.
  void settle() {
    for (int i = 0; i < SETTLING_TICKS; ++i) advance();
  }
  void advance() { forest_.advance(grid_.timeOf(++tick_)); }
  void setThreads(int threads) { forest_.setThreads(threads); }
  std::uint64_t hash() const { return forest_.hash(); }

 private:
  TickGrid grid_{RATE};
  Forest forest_;
  std::int64_t tick_;
  int twig_{0};
};

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

// Wall time, because processor time is that of all threads together.
void benchThreads(const Options& options) {
  PhysicalForest forest(256, options.quick ? 5000 : 40000);
  std::vector<bench::Candidate> candidates;
  for (const int threads : {1, 2, 4})
    candidates.push_back({std::to_string(threads), [&forest, threads] {
                            forest.setThreads(threads);
                            for (int i = 0; i < 5; ++i) forest.advance();
                          }});
  bench::timeInterleaved(candidates, options.rounds);
  std::printf("\n%zu branches: threads, ms per tick, times faster\n", forest.branchCount());
  for (const bench::Candidate& c : candidates)
    std::printf("%-8s %8.2f %8.2f\n", c.name.c_str(), 1e3 * c.seconds / 5,
                candidates[0].seconds / c.seconds);
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
    const bench::Options options =
        bench::readOptions(argc, argv, {"free", "held", "threads", "bodies"});
    bench::Table table(options.csv, bench::SIZE_COLUMNS);
    if (options.wants("free") || options.wants("held")) forest::benchForests(options, table);
    if (options.wants("threads")) forest::benchThreads(options);
    if (options.wants("bodies")) forest::benchBodies(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forest_physics_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
