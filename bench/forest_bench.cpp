// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures procedural motion: cost per branch of the plain and the batched path against each other
// and against the machine's memory, and what levels of detail save at what error (S1-41).
// usage: forest_bench [ROUNDS]

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bandwidth.h"
#include "forest/level_scene.h"
#include "vegetation_sim/common/math.h"

namespace vegetation_sim::forest {
namespace {

using bench::Candidate;

// ---- cost per branch -------------------------------------------------------------------------

wind::Field fourDiscs(double extent) {
  std::vector<wind::Primitive> out;
  for (std::uint32_t i = 0; i < 4; ++i)
    out.push_back(
        makeDisk(i + 1, Vec3(0.3 * extent * i, 0.5 * extent, 0), extent, Vec3(3.0, 1.0 - i, 0)));
  return wind::Field(out);
}

double largestDifference(const Grove& grove, const wind::Instant& wind) {
  double worst = 0.0;
  BatchPoses fast;
  for (std::size_t i = 0; i < grove.trees.size(); ++i) {
    const Tree& tree = grove.trees[i];
    const auto local = wind.relativeTo(tree.foot);
    const auto plain = poseBranches(tree, local, fullWeights());
    grove.posers[i].pose(local, fullWeights(), MAX_DEPTHS, fast);
    for (std::size_t b = 0; b < plain.size(); ++b) {
      const Branch& branch = tree.skeleton.branches[b];
      const Vec3 error = tipOf(branch, plain[b]) - tipOf(branch, fast.at(static_cast<int>(b)));
      worst = std::max(worst, length(error) / tree.skeleton.height);
    }
  }
  return worst;
}

void benchPoses(int rounds) {
  const Grove grove = growGrove(richLayout(7, 8.0, 2000));
  const wind::Instant wind = fourDiscs(60.0).at(seconds(1.7e9 + 0.4));
  std::vector<BatchPoses> poses(grove.trees.size());
  std::vector<Candidate> candidates{{"plain double", [&] {
                                       for (const Tree& tree : grove.trees)
                                         poseBranches(tree, wind.relativeTo(tree.foot),
                                                      fullWeights());
                                     }}};
  for (const std::string& set : instructionSets())
    candidates.push_back({"batched " + set, [&, set] {
                            forceInstructionSet(set);
                            for (std::size_t i = 0; i < grove.trees.size(); ++i)
                              grove.posers[i].pose(wind.relativeTo(grove.trees[i].foot),
                                                   fullWeights(), MAX_DEPTHS, poses[i]);
                            forceInstructionSet("");
                          }});
  timeInterleaved(candidates, rounds);
  const double bandwidth = bench::memoryBandwidth();
  const double bytes = BatchPoser::BYTES_PER_BRANCH + 7 * sizeof(float);  // read, written
  std::printf("Procedural pose, four winds, %zu branches in %zu trees\n", grove.branches,
              grove.trees.size());
  std::printf("memory: %.1f GB/s; a branch reads and writes %.0f bytes: floor %.2f ns\n",
              bandwidth * 1e-9, bytes, bytes / bandwidth * 1e9);
  std::printf("%-16s %12s %8s %18s\n", "path", "ns/branch", "ratio", "of bandwidth");
  for (const Candidate& c : candidates) {
    const double each = c.seconds / static_cast<double>(grove.branches);
    std::printf("%-16s %12.2f %8.1f %17.0f%%\n", c.name.c_str(), each * 1e9,
                candidates[0].seconds / c.seconds, 100.0 * bytes / each / bandwidth);
  }
  std::printf("largest difference of a tip: %.1e of the tree's height (bar 1e-5)\n\n",
              largestDifference(grove, wind));
}

// ---- levels of detail -------------------------------------------------------------------------

void benchLevels(int rounds) {
  const double spacing = 8.0, extent = 16 * spacing;
  const Grove grove = growGrove(richLayout(16, spacing, 2000));
  const Camera camera = edgeCamera(extent);
  const TickGrid grid(30);
  const std::int64_t start = grid.tickAt(seconds(1.7e9));
  std::printf(
      "256 trees, %zu branches, three discs over a third of them, camera at the edge, "
      "1280 x 900\n",
      grove.branches);
  std::printf("%-22s %10s %12s %8s %14s %12s\n", "", "ms/frame", "branches", "ratio",
              "error [pixel]", "error [m]");
  for (const double tolerance : {0.5, 0.75, 1.0, 1.5, 2.0}) {
    Settings settings;
    settings.tolerance = tolerance;
    Forest forest(grove.layout, flatTerrain(), settings);
    forest.setWind(threeDiscs(extent));
    settle(forest, camera, grid, start, 90);
    BatchPoses scratch;
    std::size_t posed = 0;
    std::int64_t tick = start + 90;
    std::vector<Candidate> candidates{
        {"all at full depth",
         [&] {
           const wind::Instant wind = forest.memory().wind.at(grid.timeOf(tick));
           for (std::size_t i = 0; i < grove.trees.size(); ++i)
             grove.posers[i].pose(wind.relativeTo(grove.trees[i].foot), fullWeights(), MAX_DEPTHS,
                                  scratch);
         }},
        {"levels", [&] {
           settle(forest, camera, grid, tick, 1);  // what choosing costs is part of it
           const Nanoseconds stamp = grid.timeOf(tick++);
           posed = poseAtLevels(grove, forest, forest.memory().wind.at(stamp), stamp, scratch);
         }}};
    timeInterleaved(candidates, rounds);
    LevelError worst;
    for (int i = 0; i < 20; ++i) {  // over two periods of the discs
      const Nanoseconds stamp = grid.timeOf(tick + 11 * i);
      const LevelError now =
          errorOfLevels(grove, forest, camera, forest.memory().wind.at(stamp), stamp);
      worst = {std::max(worst.pixels, now.pixels), std::max(worst.metres, now.metres)};
    }
    if (tolerance == 0.5)
      std::printf("%-22s %10.3f %12zu %8.1f %14s %12s\n", "all at full depth",
                  candidates[0].seconds * 1e3, grove.branches, 1.0, "0", "0");
    std::printf("levels, %.2f pixel     %10.3f %12zu %8.1f %14.2f %12.3f\n", tolerance,
                candidates[1].seconds * 1e3, posed, candidates[0].seconds / candidates[1].seconds,
                worst.pixels, worst.metres);
  }
  std::printf("\n");
}

void benchGrowth(int rounds) {
  const Layout layout = gridLayout(16, 8.0);
  std::size_t branches = 0;
  std::vector<Candidate> candidates{
      {"grow", [&] {
         branches = 0;
         for (std::uint32_t id = 0; id < layout.treeCount(); ++id)
           branches +=
               grow(layout.trees[id], layout.species[layout.trees[id].species]).branches.size();
       }}};
  timeInterleaved(candidates, rounds);
  std::printf("growing 256 trees, %zu branches, from their seeds: %.0f ns/branch, %.0f us/tree\n",
              branches, candidates[0].seconds / static_cast<double>(branches) * 1e9,
              candidates[0].seconds / 256 * 1e6);
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  vegetation_sim::forest::benchPoses(rounds);
  vegetation_sim::forest::benchLevels(rounds);
  vegetation_sim::forest::benchGrowth(rounds);
  return 0;
}
