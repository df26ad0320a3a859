// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace vegetation_sim::bench {

/// One of several ways to do the same work.
struct Candidate {
  std::string name;
  std::function<void()> run;
  double seconds{0.0};  ///< median of its rounds
  double least{0.0};    ///< [s]
};

/// Times candidates in turn, A B C A B C ..., so that slow phases of a shared machine affect all of
/// them alike. Fills in each median after one round that is not counted.
inline void timeInterleaved(std::vector<Candidate>& candidates, int rounds) {
  using Clock = std::chrono::steady_clock;
  std::vector<std::vector<double>> times(candidates.size());
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const auto start = Clock::now();
      candidates[i].run();
      const std::chrono::duration<double> spent = Clock::now() - start;
      if (round >= 0) times[i].push_back(spent.count());
    }
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    candidates[i].seconds = times[i][times[i].size() / 2];
    candidates[i].least = times[i].front();
  }
}

}  // namespace vegetation_sim::bench
