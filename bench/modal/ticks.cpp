// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "modal/measure.h"
#include "processor_time.h"
#include "scenes/forest/modal_forest_scene.h"

namespace vegetation_sim::bench {
void measureTicks() {
  std::printf("\nfour oaks that get fine modes in a breeze, ticks of 60 Hz [ms]\n");
  std::printf("| branches | median tick | longest, work of its thread | longest, with waiting |\n");
  for (const std::size_t branches : {250u, 800u, 2000u, 6000u}) {
    forest::Clearing scene(forest::breeze(), 0.05);
    scene.forest.setLayout(forest::fourOaks(branches), forest::flatTerrain());
    scene.forest.precompute();
    double longest = 0.0;
    std::vector<double> work;
    auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 6 * forest::TICK_RATE; ++i) {
      // Other threads have the time between ticks, as in a node.
      std::this_thread::sleep_until(start + std::chrono::microseconds(1000000 / forest::TICK_RATE));
      start = std::chrono::steady_clock::now();
      const double before = threadTime();
      scene.advance();
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
      work.push_back(threadTime() - before);
      longest = std::max(longest, wall.count());
    }
    std::sort(work.begin(), work.end());
    int fine = 0;
    for (std::uint32_t id = 0; id < 4; ++id) {
      const forest::ModalTreeState* state = scene.forest.sensed().modes.find(id);
      fine += state && state->fine();
    }
    std::printf("| %zu | %.2f | %.1f | %.1f | %d fine\n", scene.tree(0).skeleton.branches.size(),
                1e3 * work[work.size() / 2], 1e3 * work.back(), 1e3 * longest, fine);
    std::fflush(stdout);
  }
}

}  // namespace vegetation_sim::bench
