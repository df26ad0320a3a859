// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/scaling.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace vegetation_sim::bench {
namespace {

using Engines = std::vector<std::unique_ptr<Engine>>;
constexpr double LEAST_TIME = 0.1;  // of a measurement [s]

void stepMany(Engine& engine, int count, double h) {
  for (int i = 0; i < count; ++i) engine.step(LOADED_INTERVALS / 2, 0.5, h);
}

// Returns the real time in which each of the first engines has taken `count` steps [s].
double timeOf(const Engines& engines, int threads, int count, double h) {
  for (const auto& engine : engines) engine->rest();
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::thread> workers;
  for (int i = 1; i < threads; ++i)
    workers.emplace_back([&, i] { stepMany(*engines[static_cast<std::size_t>(i)], count, h); });
  stepMany(*engines.front(), count, h);
  for (std::thread& worker : workers) worker.join();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

double scalingOf(const Maker& maker, const TestTree& tree, const TestLoad& load,
                 const std::string& cache, double steps, int threads, int rounds) {
  Engines engines;
  for (int i = 0; i < threads; ++i) engines.push_back(maker.make(tree, load, cache));
  const double h = INTERVAL / std::max(1.0, steps);
  int count = 1;
  while (timeOf(engines, 1, count, h) < LEAST_TIME) count *= 2;
  std::vector<double> ratios;
  for (int round = 0; round < rounds; ++round)
    ratios.push_back(threads * timeOf(engines, 1, count, h) / timeOf(engines, threads, count, h));
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

}  // namespace vegetation_sim::bench
