// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

#include "interleaved.h"

namespace vegetation_sim::bench {

/// Returns the processor time of this process [s], which does not depend on other users of the
/// machine.
inline double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Returns the processor time of the calling thread [s].
inline double threadTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Does timeInterleaved in processor time, for work of one thread.
inline void timeOnProcessor(std::vector<Candidate>& candidates, int rounds) {
  std::vector<std::vector<double>> times(candidates.size());
  for (int round = -1; round < rounds; ++round)
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const double start = processorTime();
      candidates[i].run();
      if (round >= 0) times[i].push_back(processorTime() - start);
    }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    candidates[i].seconds = times[i][times[i].size() / 2];
    candidates[i].least = times[i].front();
  }
}

}  // namespace vegetation_sim::bench
