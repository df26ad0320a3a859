// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <memory>

#include "crowd/sections.h"
#include "processor_time.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim::crowd::bench {
namespace {

constexpr double TICK = 1.0 / 60.0;

// Returns walkers and trunks as dense as 1 000 and 10 000 are on 300 m by 300 m.
std::unique_ptr<Crowd> forestCrowd(int walkers, int trunks, double side, bool boxes) {
  auto out = std::make_unique<Crowd>(3, CrowdSettings(), Area{0.0, side, 0.0, side}, flatGround());
  const Random random(11);
  std::vector<Obstacle> all;
  for (int i = 0; i < trunks; ++i) {
    const auto k = static_cast<std::uint64_t>(4 * i);
    const Point at{random.uniform(k, 0.0, side), random.uniform(k + 1, 0.0, side)};
    const double radius = random.uniform(k + 2, 0.1, 0.4);
    all.push_back(boxes ? boxObstacle(at, radius, radius, random.uniform(k + 3, -PI, PI))
                        : discObstacle(at, radius));
  }
  out->setObstacles(std::move(all));
  const Random places(12);
  for (int i = 0; i < walkers; ++i) {
    Spawn spawn;
    const auto k = static_cast<std::uint64_t>(3 * i);
    spawn.position = {places.uniform(k, 0.0, side), places.uniform(k + 1, 0.0, side)};
    spawn.heading = places.uniform(k + 2, -PI, PI);
    out->spawn(spawn);
  }
  return out;
}

void steps(Crowd& crowd, int count) {
  for (int i = 0; i < count; ++i) crowd.advance(crowd.snapshot().stamp + fromSeconds(TICK));
}

double nearestGap(const View& view) {
  return view.count > 0 ? view.at(0).gap : view.beyond;
}

// Finds the nearest obstacle of some walkers by the grid, and by measuring the distance to
// everything.
void againstAll(const Crowd& crowd, int rounds) {
  const std::vector<Walker>& walkers = crowd.walkers();
  WalkerGrid grid;
  grid.build(walkers, 3.5);
  const std::vector<Obstacle> robots;
  const Surroundings around{&crowd.obstacles(), &grid, &robots};
  constexpr std::uint32_t ASKED = 50;  // number of walkers that are measured without the grid
  std::vector<double> by_grid(ASKED), by_all(ASKED);
  std::vector<::vegetation_sim::bench::Candidate> candidates{
      {"grid",
       [&] {
         // Neighbours follow each other, as in a step.
         for (const WalkerGrid::Spot& spot : grid.spots()) {
           const View view = perceive(walkers[spot.index], spot.index, around, 3.0, 3);
           if (spot.index < ASKED) by_grid[spot.index] = nearestGap(view);
         }
       }},
      {"all", [&] {
         for (std::uint32_t i = 0; i < ASKED; ++i)
           by_all[i] = nearestGap(perceiveAll(walkers[i], i, walkers, around, 3.0, 3));
       }}};
  ::vegetation_sim::bench::timeOnProcessor(candidates, rounds);
  const double grid_cost = candidates[0].seconds / static_cast<double>(walkers.size());
  const double all_cost = candidates[1].seconds / ASKED;
  std::printf("  perception: grid %.0f ns, all %.0f ns a walker: %.0fx; same answers: %s\n",
              grid_cost * 1e9, all_cost * 1e9, all_cost / grid_cost,
              by_grid == by_all ? "yes" : "NO");
}

}  // namespace

void benchScale(int rounds) {
  for (const bool boxes : {false, true}) {
    std::printf("trunks are %s\n", boxes ? "boxes" : "round");
    for (const int walkers : {100, 1000, 5000, 20000, 50000}) {
      const double side = 300.0 * std::sqrt(std::max(1.0, walkers / 1000.0));
      const int trunks = walkers <= 1000 ? 10000 : 10 * walkers;
      const auto crowd = forestCrowd(walkers, trunks, side, boxes);
      steps(*crowd, 60);
      const int count = std::max(1, 5000 / walkers);
      std::vector<::vegetation_sim::bench::Candidate> candidates{
          {"step", [&] { steps(*crowd, count); }}};
      ::vegetation_sim::bench::timeOnProcessor(candidates, rounds);
      const double seconds = candidates[0].seconds / count;
      std::printf(
          "  %6d walkers, %6d trunks: %7.3f ms a step, %4.0f ns a walker; at 60 Hz one core "
          "takes %.0f\n",
          walkers, trunks, seconds * 1e3, seconds / walkers * 1e9,
          walkers * (1.0 / 60.0) / seconds);
      if (walkers == 1000) againstAll(*crowd, rounds);
    }
  }
}

}  // namespace vegetation_sim::crowd::bench
