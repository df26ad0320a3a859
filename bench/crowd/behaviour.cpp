// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "crowd/sections.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd::bench {
namespace {

constexpr double TICK = 1.0 / 30.0;

// Counts the pairs that pass each other within 30 s.
int headOnPasses(int seeds, const CrowdSettings& settings) {
  int passed = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Crowd crowd = headOn(static_cast<std::uint64_t>(seed), settings);
    bool all = false;
    run(crowd, 30.0, TICK, [&](const Crowd& c) { all = all || allArrived(c); });
    passed += all;
  }
  return passed;
}

double circleTime(int count, double radius, std::uint64_t seed, const CrowdSettings& settings,
                  int& arrived) {
  Crowd crowd = circle(count, radius, seed, settings);
  double time = 0.0, end = 0.0;
  run(crowd, 120.0, TICK, [&](const Crowd& c) {
    time += TICK;
    if (end == 0.0 && allArrived(c)) end = time;
  });
  arrived = 0;
  for (const Walker& w : crowd.walkers()) arrived += w.arrived;
  return end;
}

int trapEscapes(int seeds, const CrowdSettings& settings) {
  int out = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    Crowd crowd = trap(static_cast<std::uint64_t>(seed), 3.0 + seed % 3, settings);
    bool all = false;
    run(crowd, 120.0, TICK, [&](const Crowd& c) { all = all || allArrived(c); });
    out += all;
  }
  return out;
}

// Measures the mean speed along the corridor over the free speed while the two groups cross, and
// how often the turn of a walker changes its sign, per second; turns below 0.1 rad/s do not count.
void corridorFlow(double width, int seeds, const CrowdSettings& settings, double& speed,
                  double& flips) {
  speed = flips = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    Crowd crowd = corridor(width, static_cast<std::uint64_t>(seed), settings);
    std::vector<int> sign(20, 0);
    std::vector<double> start;
    for (const Walker& w : crowd.walkers()) start.push_back(w.position.x);
    run(crowd, 20.0, TICK, [&](const Crowd& c) {
      for (std::size_t i = 0; i < 20; ++i) {
        const double rate = c.walkers()[i].turn_rate;
        const int now = rate > 0.1 ? 1 : rate < -0.1 ? -1 : 0;
        if (now == 0) continue;
        flips += sign[i] == -now;
        sign[i] = now;
      }
    });
    for (std::size_t i = 0; i < 20; ++i) {
      const Walker& w = crowd.walkers()[i];
      speed += (w.position.x - start[i]) * (w.goal.x > 0.0 ? 1.0 : -1.0) / (20.0 * w.speed);
    }
  }
  speed /= 20.0 * seeds;
  flips /= 20.0 * 20.0 * seeds;
}

void penetrations(int seeds, const CrowdSettings& settings) {
  std::printf("  deepest overlap in a room of 10 m, %d seeds:", seeds);
  for (const double dt : {1.0 / 60.0, 0.1, 0.25, 0.5, 1.0, 2.0, 10.0}) {
    double worst = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
      Crowd crowd = crowdedRoom(static_cast<std::uint64_t>(seed), settings);
      run(crowd, std::max(30.0, 60.0 * dt), dt,
          [&](const Crowd& c) { worst = std::max(worst, c.deepestOverlap()); });
    }
    std::printf("  %.3g s: %.1e m", dt, worst);
  }
  std::printf("\n");
}

void table(const char* name, const CrowdSettings& settings, int seeds) {
  std::printf("%s\n  head-on pair passes: %d of %d\n", name, headOnPasses(10 * seeds, settings),
              10 * seeds);
  for (const int count : {20, 50}) {
    int arrived = 0;
    const double time = circleTime(count, count == 20 ? 8.0 : 15.0, 1, settings, arrived);
    std::printf("  circle of %d: %d arrived, %.1f s\n", count, arrived, time);
  }
  std::printf("  U left: %d of %d\n", trapEscapes(2 * seeds, settings), 2 * seeds);
  for (const double width : {1.5, 3.0, 6.0}) {
    double speed, flips;
    corridorFlow(width, std::max(1, seeds / 4), settings, speed, flips);
    std::printf("  counterflow, %.1f m: %.2f of free speed, %.2f turn flips per walker second\n",
                width, speed, flips);
  }
  penetrations(seeds, settings);
}

}  // namespace

void benchBehaviour(int seeds) {
  CrowdSettings settings;
  table("goal", settings, seeds);
  settings.behaviour = Behaviour::PAPER;
  settings.neighbours = 1;
  table("paper's law", settings, seeds);
  settings.noise = NoiseLaw::PRINTED;
  table("paper's law, noise as printed", settings, seeds);
}

}  // namespace vegetation_sim::crowd::bench
