// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "trees/engine.h"

#include <ctime>

namespace vegetation_sim::bench {
namespace {

double squaredDistance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out += (a[i] - b[i]).squaredNorm();
  return out;
}

}  // namespace

double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<Vec3> tipsOf(const TestTree& tree, Bend bend, const std::vector<double>& q) {
  const TestLoad none;
  std::vector<double> state(4 * tree.links.size(), 0.0);
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    state[4 * i] = q[2 * i];
    state[4 * i + 1] = q[2 * i + 1];
  }
  return ReferenceChain(tree, none, bend).tips(state);
}

Drive drive(Engine& engine, const Reference& reference, int steps, double cap) {
  double farthest = 0.0;
  for (const auto& instant : reference.motion)
    farthest = std::max(farthest, squaredDistance(instant, reference.rest[0]));
  const double h = INTERVAL / steps, start = processorTime();
  const auto intervals = static_cast<int>(reference.motion.size());
  Drive out;
  engine.rest();
  for (int interval = 0; interval < intervals && !out.broken; ++interval) {
    for (int i = 0; i < steps; ++i) engine.step(interval, INTERVAL * interval + h * i, h);
    out.motion.push_back(engine.tips());
    const double off =
        squaredDistance(out.motion.back(), reference.motion[static_cast<std::size_t>(interval)]);
    out.broken = !(off < 4.0 * farthest);  // not a number counts as unstable
    if (processorTime() - start > cap) break;
  }
  out.seconds = processorTime() - start;
  return out;
}

}  // namespace vegetation_sim::bench
