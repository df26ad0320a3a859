// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Measures the ranges of a lidar in the middle of the shipped scenario `forest` against those of
// the full model, in which every joint of the trees in its range is physical, with no viewer, with
// one that looks away and with one that looks at the lidar; and compares the state hashes and what
// the rays meet among the three.
// usage: range_bench [--quick] [--part free,capped]
//   free: 1000 trees may have modes at once; capped: 64, the default
#include <cstdio>

#include "options.h"
#include "scenes/sensors/range_error_scene.h"

int main(int argc, char** argv) {
  using namespace vegetation_sim;
  try {
    bench::Options options = bench::readOptions(argc, argv, {"free", "capped"});
    const scenes::ShippedScene scene = scenes::loadShippedScene("forest");
    const int seconds = options.quick ? 2 : 8;
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
