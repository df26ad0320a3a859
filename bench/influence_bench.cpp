// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures cost and error of making only some branches of a pulled oak physical, by predicted
// influence and by the paper's rule of depth, while the rest hangs on as rigid clusters. The
// reference has no clusters: all of it is physical.
// usage: influence_bench [ROUNDS] [--quick | --full] [--csv FILE]

#include <cstdio>

#include "options.h"
#include "processor_time.h"
#include "scenes/forest/physics_scene.h"
#include "table.h"

namespace vegetation_sim::forest {
namespace {

using bench::Options;

constexpr double PULL = 1.0, WATCHED = 2.0;  // [s]

struct Run {
  /// displacement of the tip of the pulled branch from rest, each tick [m]
  std::vector<Vec3> tip;
  double seconds{0.0};      ///< processor time of a tick while it is observed
  std::size_t branches{0};  ///< largest number of physical branches
};

/// Pulls a branch of depth `depth` by 20 N for a second. With `all`, the whole tree is physical.
Run pull(const PhysicsSettings& settings, int depth, bool all) {
  PhysicsRig rig(settings);
  const int branch = rig.branchOfDepth(depth);
  if (all) rig.touch(rig.twig(), 9.0);
  Push push;
  push.point = {0, branch, rig.branches()[static_cast<std::size_t>(branch)].length};
  push.force = Vec3(0.0, 18.0, -9.0);
  push.until = rig.now() + seconds(PULL);
  rig.forest.push(push);
  Run out;
  const Vec3 rest = rig.tip(branch);
  const auto ticks = static_cast<int>(WATCHED * TICK_RATE);
  for (int i = 0; i < ticks; ++i) {
    const double start = bench::processorTime();
    rig.advance();
    out.seconds += (bench::processorTime() - start) / ticks;
    out.tip.push_back(rig.tip(branch) - rest);
    out.branches = std::max(out.branches, rig.forest.physicsFigures().branches);
  }
  return out;
}

double rmsOf(const std::vector<Vec3>& values) {
  double sum = 0.0;
  for (const Vec3& v : values) sum += dot(v, v);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Returns the median cost of some equal runs.
Run repeated(const PhysicsSettings& settings, int depth, bool all, int rounds) {
  std::vector<double> times;
  Run out;
  for (int i = 0; i < rounds; ++i) {
    out = pull(settings, depth, all);
    times.push_back(out.seconds);
  }
  std::sort(times.begin(), times.end());
  out.seconds = times[times.size() / 2];
  return out;
}

class Ladders {
 public:
  Ladders(const Options& options, int depth) : rounds_(options.quick ? 1 : 5), depth_(depth) {
    truth_ = repeated(byDepth(), depth_, true, rounds_);
    std::printf("a branch of depth %d, %zu branches all physical: %.0f us a tick\n", depth_,
                truth_.branches, 1e6 * truth_.seconds);
  }
  static PhysicsSettings byDepth() {
    PhysicsSettings out;
    out.promotion = Promotion::DEPTH;
    return out;
  }

  void influence(bench::Table& table) {
    for (const double tolerance : {0.3, 0.1, 0.03, 0.01, 0.005, 0.002, 0.0005, 0.0001}) {
      PhysicsSettings settings;
      const bool chosen = tolerance == settings.influence_tolerance;
      settings.influence_tolerance = tolerance;
      report(table, "influence", tolerance, settings, chosen);
    }
  }
  void depth(bench::Table& table) { report(table, "depth", depth_, byDepth(), false); }
  void all(bench::Table& table) const {
    table.row("all " + std::to_string(depth_), truth_.branches, truth_.branches, truth_.seconds,
              0.0, 0);
  }

 private:
  void report(bench::Table& table, const char* ladder, double setting,
              const PhysicsSettings& settings, bool chosen) {
    Run run = repeated(settings, depth_, false, rounds_);
    const std::size_t branches = run.branches;
    for (std::size_t i = 0; i < run.tip.size(); ++i) run.tip[i] -= truth_.tip[i];
    const double error = rmsOf(run.tip) / rmsOf(truth_.tip);
    std::printf("%-10s %8.4g: %5zu branches, %7.1f us a tick, tip %.2f %% off\n", ladder, setting,
                branches, 1e6 * run.seconds, 100.0 * error);
    table.row(std::string(ladder) + " " + std::to_string(depth_), branches, setting, run.seconds,
              error, int(chosen));
  }

  int rounds_, depth_;
  Run truth_;
};

}  // namespace
}  // namespace vegetation_sim::forest

int main(int argc, char** argv) {
  try {
    using namespace vegetation_sim;
    const bench::Options options = bench::readOptions(argc, argv, {});
    bench::Table table(options.csv, bench::LADDER_COLUMNS);
    for (const int depth : {1, 2, 3}) {
      forest::Ladders ladders(options, depth);
      ladders.influence(table);
      ladders.depth(table);
      ladders.all(table);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "influence_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
