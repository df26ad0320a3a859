// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the ranges of a lidar in the middle of the shipped scenario `forest` against those of
// the full model, in which every joint of the trees in its range is physical, with no viewer, with
// one that looks away and with one that looks at the lidar; and compares the state hashes and what
// the rays meet among the three.
// usage: range_bench [--quick] [--part free,capped,tolerance] [--csv FILE]
//   free: 1000 trees may have modes at once; capped: 64, the default
//   tolerance: error and processor time by the tolerance of the sensor, which the file holds
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "processor_time.h"
#include "scenes/sensors/range_error_scene.h"
#include "table.h"

namespace vegetation_sim::scan {
namespace {

constexpr double SHIPPED_TOLERANCE = 0.05;                          // of vegetation_scanner [m]
constexpr int RATE_OF_TICKS = 30, TICKS_OF_SWEEP = 3, WARM_UP = 8;  // [Hz], of 10 Hz, [s]

/// The forest of a scenario for a sensor with one tolerance, and what a tick and the poses of a
/// sweep cost.
struct Sensed {
  Sensed(const scenes::ShippedScene& scene, const RangeLidar& lidar)
      : lidar(lidar), forest(*scene.forest, scene.terrain, scene.wind) {}
  void advance(Nanoseconds stamp, bool key_frame) {
    const double start = bench::processorTime();
    forest.forest().setSensor({"lidar", lidar.place, lidar.range, lidar.tolerance, stamp});
    forest.advance(stamp, key_frame);
    ticking += bench::processorTime() - start;
    ++ticks;
  }
  void pose(Nanoseconds stamp) {
    const double start = bench::processorTime();
    forest.pose(lidar, stamp);
    posing += bench::processorTime() - start;
    ++sweeps;
  }
  /// Returns the processor time of a sweep: its ticks and the poses [s].
  double secondsOfSweep() const { return TICKS_OF_SWEEP * ticking / ticks + posing / sweeps; }

  RangeLidar lidar;
  SensedForest forest;
  RangeErrors errors;
  double ticking{0.0}, posing{0.0};
  int ticks{0}, sweeps{0};
};

/// All tolerances are measured against one forest of the full model.
void measureTolerances(const scenes::ShippedScene& scene, const RangeLidar& lidar, int seconds,
                       bench::Table& table) {
  SensedForest full(*scene.forest, scene.terrain, scene.wind);
  makeWhole(full.forest(), treesNear(scene, lidar));
  std::vector<std::unique_ptr<Sensed>> sensed;
  for (const double tolerance : {0.0025, 0.005, 0.01, 0.02, 0.05, 0.2}) {
    RangeLidar each = lidar;
    each.tolerance = tolerance;
    sensed.push_back(std::make_unique<Sensed>(scene, each));
  }
  const TickGrid grid(RATE_OF_TICKS);
  const std::int64_t first = grid.tickAt(START);
  for (int i = 0; i < (WARM_UP + seconds) * RATE_OF_TICKS; ++i) {
    const Nanoseconds stamp = grid.timeOf(first + i);
    full.advance(stamp, i % RATE_OF_TICKS == 0);
    if (i == WARM_UP * RATE_OF_TICKS)
      for (auto& each : sensed) each->ticking = each->ticks = 0;
    for (auto& each : sensed) each->advance(stamp, i % RATE_OF_TICKS == 0);
    if (i < WARM_UP * RATE_OF_TICKS || i % 12 != 0) continue;
    full.pose(lidar, stamp);
    for (auto& each : sensed) {
      each->pose(stamp);
      addErrors(lidar, full, each->forest, each->errors);
    }
  }
  int tier = 0;
  for (const auto& each : sensed) {
    const double error = quantileOf(each->errors.displaced, 0.99);
    std::printf("range %2.0f m, tolerance %6.4f m: %8.2f ms a sweep, 99 %% below %7.4f m\n",
                lidar.range, each->lidar.tolerance, 1e3 * each->secondsOfSweep(), error);
    table.row(std::to_string(static_cast<int>(lidar.range)), tier++, each->lidar.tolerance,
              each->secondsOfSweep(), error, each->lidar.tolerance == SHIPPED_TOLERANCE);
  }
}

}  // namespace
}  // namespace vegetation_sim::scan

int main(int argc, char** argv) {
  using namespace vegetation_sim;
  try {
    bench::Options options = bench::readOptions(argc, argv, {"free", "capped", "tolerance"});
    const scenes::ShippedScene scene = scenes::loadShippedScene("forest");
    const int seconds = options.quick ? 2 : 8;
    if (options.wants("tolerance")) {
      bench::Table table(options.csv, bench::LADDER_COLUMNS);
      for (const double range : {15.0, 30.0})
        if (range < 20.0 || !options.quick)
          scan::measureTolerances(scene, scan::lidarInForest(scene, range), options.quick ? 1 : 4,
                                  table);
    }
    for (const double range : {20.0, 100.0}) {
      if (options.quick && range > 20.0) break;
      const scan::RangeLidar lidar = scan::lidarInForest(scene, range);
      for (const int modal_trees : {64, 1000})
        if (options.wants(modal_trees == 64 ? "capped" : "free"))
          scan::printWatched(lidar, modal_trees,
                             scan::compareWatched(scene, lidar, 8, seconds, modal_trees));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "range_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
