// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures procedural motion: cost per branch of the plain and the batched path against each other
// and against the machine's memory, and what levels of detail save at what error (S1-41).
// usage: forest_bench [ROUNDS] [--quick | --full] [--part poses,levels,growth,million] [--csv FILE]
// The file holds the part `levels`.

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bandwidth.h"
#include "options.h"
#include "processor_time.h"
#include "scenes/forest/level_scene.h"
#include "scenes/forest/physics_scene.h"
#include "table.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

using bench::Candidate;
using bench::Options;

// ---- cost per branch -------------------------------------------------------------------------

wind::Field fourDiscs(double extent) {
  std::vector<wind::Primitive> out;
  for (std::uint32_t i = 0; i < 4; ++i)
    out.push_back(
        makeDisk(i + 1, Vec3(0.3 * extent * i, 0.5 * extent, 0), extent, Vec3(3.0, 1.0 - i, 0)));
  return wind::Field(out);
}

double largestDifference(const TreeBatch& grove, const wind::Instant& wind) {
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
  const TreeBatch grove = growTrees(richLayout(7, 8.0, 2000));
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

std::size_t poseAtLevel(const TreeBatch& grove, int level, const wind::Instant& wind,
                        BatchPoses& scratch) {
  Weights weights{};
  std::fill_n(weights.begin(), level, 1.0);
  std::size_t posed = 0;
  for (std::size_t i = 0; i < grove.trees.size(); ++i) {
    grove.posers[i].pose(wind.relativeTo(grove.trees[i].foot), weights, level, scratch);
    posed += static_cast<std::size_t>(scratch.count);
  }
  return posed;
}

// Remaining motion and its cost for one choice of levels.
struct LevelPoint {
  double seconds{0.0}, all_seconds{0.0};  ///< per frame: at the chosen levels, at full depth
  std::size_t posed{0};
  LevelError worst;
};

// Without `camera`, every tree has the fixed level of `settings`.
LevelPoint measureLevels(const TreeBatch& grove, const Settings& settings, const Camera* camera,
                         double extent, const Options& options) {
  const Camera edge = edgeCamera(extent);
  const TickGrid grid(30);
  std::int64_t tick = grid.tickAt(seconds(1.7e9));
  Forest forest(grove.layout, flatTerrain(), settings);
  forest.setWind(threeDiscs(extent));
  const auto advance = [&](int ticks) {
    if (camera)
      settle(forest, *camera, grid, tick, ticks);
    else
      for (int i = 0; i < ticks; ++i) forest.advance(grid.timeOf(tick + i));
    tick += ticks;
  };
  advance(90);
  LevelPoint out;
  BatchPoses scratch;
  std::vector<Candidate> candidates{
      {"all at full depth",
       [&] {
         const wind::Instant wind = forest.snapshot().wind.at(grid.timeOf(tick));
         for (std::size_t i = 0; i < grove.trees.size(); ++i)
           grove.posers[i].pose(wind.relativeTo(grove.trees[i].foot), fullWeights(), MAX_DEPTHS,
                                scratch);
       }},
      {"levels", [&] {
         advance(1);  // the cost includes the choice of levels
         const Nanoseconds stamp = grid.timeOf(tick - 1);
         const wind::Instant wind = forest.snapshot().wind.at(stamp);
         out.posed = camera ? poseAtLevels(grove, forest, wind, stamp, scratch)
                            : poseAtLevel(grove, settings.fixed_level, wind, scratch);
       }}};
  timeInterleaved(candidates, options.rounds);
  out.all_seconds = candidates[0].seconds;
  out.seconds = candidates[1].seconds;
  const int instants = options.quick ? 5 : 20;  // over two periods of the disks
  for (int i = 0; i < instants; ++i) {
    const Nanoseconds stamp = grid.timeOf(tick + 220 * i / instants);
    const LevelError now =
        errorOfLevels(grove, forest, edge, forest.snapshot().wind.at(stamp), stamp);
    out.worst = {std::max(out.worst.pixels, now.pixels), std::max(out.worst.metres, now.metres)};
  }
  return out;
}

void benchLevels(const Options& options, bench::Table& table) {
  const double spacing = 8.0;
  const int side = options.quick ? 6 : 16;
  const TreeBatch grove = growTrees(richLayout(side, spacing, options.quick ? 500 : 2000));
  const Camera camera = edgeCamera(side * spacing);
  std::printf(
      "%zu trees, %zu branches, three discs over a third of them, camera at the edge, "
      "1280 x 900\n",
      grove.trees.size(), grove.branches);
  std::printf("%-22s %10s %12s %8s %14s %12s\n", "", "ms/frame", "branches", "ratio",
              "error [pixel]", "error [m]");
  const auto report = [&](const std::string& name, const char* ladder, double setting,
                          const LevelPoint& point, bool chosen) {
    std::printf("%-22s %10.3f %12zu %8.1f %14.2f %12.3f\n", name.c_str(), point.seconds * 1e3,
                point.posed, point.all_seconds / point.seconds, point.worst.pixels,
                point.worst.metres);
    table.row(ladder, point.posed, setting, point.seconds, point.worst.pixels, int(chosen));
  };
  for (int level = 0; level <= MAX_DEPTHS; ++level) {
    Settings settings;
    settings.fixed_level = level;
    report("level " + std::to_string(level) + " for all", "one level for all", level,
           measureLevels(grove, settings, nullptr, side * spacing, options), false);
  }
  for (const double tolerance : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 4.0, 8.0}) {
    Settings settings;
    const bool chosen = tolerance == settings.tolerance;
    settings.tolerance = tolerance;
    char name[40];
    std::snprintf(name, sizeof name, "levels, %.2f pixel", tolerance);
    report(name, "by tolerance", tolerance,
           measureLevels(grove, settings, &camera, side * spacing, options), chosen);
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

// ---- a million trees ---------------------------------------------------------------------------

constexpr int SIDE = 1000;  // trees
constexpr double SPACING = 8.0;

// Moves 15 people of 1.5 m/s around the middle, each on a circle of its own through the trees.
void moveBodies(Forest& forest, const Vec3& middle, Nanoseconds stamp) {
  for (int i = 0; i < 15; ++i) {
    Body body;
    body.id = "person_" + std::to_string(i);
    body.shape = Shape::CAPSULE;
    body.size = Vec3(0.25, 0.0, 1.2);
    const double radius = 2.0 * SPACING + i, speed = 1.5;
    const double angle = i + secondsBetween(PHYSICS_START, stamp) * speed / radius;
    const Vec3 out(std::cos(angle), std::sin(angle), 0.0);
    body.pose.position = middle + Vec3(0.0, 0.0, 0.85) + radius * out;
    body.velocity = speed * Vec3(-out.y(), out.x(), 0.0);
    body.stamp = stamp;
    forest.setBody(body);
  }
}

// Measures ticks of 30 Hz with a viewer in the middle, in a breeze, in small and large forests.
void benchMillion() {
  std::printf("explicit trees, one viewer, 15 bodies: ms per tick of its thread (bar 4)\n");
  std::printf("%10s %10s %10s %18s\n", "trees", "median", "longest", "physical branches");
  for (const int side : {64, SIDE}) {
    Layout layout = gridLayout(side, SPACING);
    for (TreeSeed& seed : layout.trees) seed.yaw = std::remainder(seed.yaw, 2.0 * PI);
    const Vec3 middle = 0.5 * side * SPACING * Vec3(1.0, 1.0, 0.0);
    Forest forest(std::move(layout), flatTerrain(), Settings());
    forest.setWind(wind::Field({makeBreeze(1, Vec3(5, 1, 0))}));
    Camera camera = edgeCamera(SPACING);
    camera.eye.position = middle + Vec3(-40.0, 0.0, 3.0);
    const TickGrid grid(30);
    const std::int64_t first = grid.tickAt(PHYSICS_START);
    std::vector<double> times;
    for (int i = 0; i < 400; ++i) {
      moveBodies(forest, middle, grid.timeOf(first + i));
      const double before = bench::threadTime();
      settle(forest, camera, grid, first + i, 1);
      if (i >= 100) times.push_back(bench::threadTime() - before);
    }
    std::sort(times.begin(), times.end());
    std::printf("%10zu %10.2f %10.2f %18zu\n", forest.layout().trees.size(),
                1e3 * times[times.size() / 2], 1e3 * times.back(),
                forest.physicsFigures().branches);
  }
  std::printf("\n");
}

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    const bench::Options options =
        bench::readOptions(argc, argv, {"poses", "levels", "growth", "million"});
    bench::Table table(options.csv, bench::LADDER_COLUMNS);
    if (options.wants("poses")) forest::benchPoses(options.rounds);
    if (options.wants("levels")) forest::benchLevels(options, table);
    if (options.wants("growth")) forest::benchGrowth(options.rounds);
    if (options.wants("million")) forest::benchMillion();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "forest_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
