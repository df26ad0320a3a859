// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "crowd/sections.h"
#include "processor_time.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd::bench {
namespace {

constexpr double TICK = 1.0 / 30.0;

double peakMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::uint64_t goalsOf(const Crowd& crowd) {
  std::uint64_t out = 0;
  for (const Walker& walker : crowd.walkers()) out += walker.goals;
  return out;
}

}  // namespace

void benchGoals(double seconds) {
  for (const int walkers : {100, 1000, 3000}) {
    Crowd crowd = houseOfRooms(walkers, 200.0, 1);
    const double before = peakMegabytes();
    std::vector<double> ticks;
    double metres = 0.0;
    run(crowd, TICK, TICK);  // all get their first goal
    for (double time = 0.0; time < seconds; time += TICK) {
      const double start = ::vegetation_sim::bench::processorTime();
      crowd.advance(crowd.snapshot().stamp + fromSeconds(TICK));
      ticks.push_back(::vegetation_sim::bench::processorTime() - start);
      for (const Walker& walker : crowd.walkers()) metres += TICK * length(walker.velocity);
    }
    std::sort(ticks.begin(), ticks.end());
    std::printf(
        "%5d wanderers in rooms on 200 m, %.0f s: longest tick %.1f ms, median %.2f ms; "
        "%.0f MB more; %.2f m/s; %.2f goals a walker\n",
        walkers, seconds, ticks.back() * 1e3, ticks[ticks.size() / 2] * 1e3,
        peakMegabytes() - before, metres / (walkers * seconds),
        static_cast<double>(goalsOf(crowd)) / walkers);
    std::fflush(stdout);
  }
}

}  // namespace vegetation_sim::crowd::bench
