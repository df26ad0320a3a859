// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/tier_allocation.h"

#include <algorithm>

#include "vegetation_sim/core/lod/viewpoint.h"

namespace vegetation_sim {
namespace {

constexpr double LEAST_COST = 1e-6;  // of a step upwards

/// A step of one choice from a tier to a finer one.
struct Step {
  double priority;  // error per cost
  double cost;
  std::size_t index;
  int from, to;
};

double errorAt(const TierChoice& choice, int tier) {
  return choice.error[static_cast<std::size_t>(tier)];
}

double costAt(const TierChoice& choice, int tier) {
  return choice.cost[static_cast<std::size_t>(tier)];
}

// Adds the steps of a choice up to the tier that it wants. Priorities never rise, so that a later
// step never goes before an earlier one.
void addSteps(const TierChoice& choice, std::size_t index, std::vector<Step>& out) {
  double least = 1e300;
  const auto add = [&](int from, int to) {
    const double cost = costAt(choice, to) - costAt(choice, from);
    const double held = choice.held >= to ? STICKY : 1.0;
    least = std::min(least, held * errorAt(choice, from) / std::max(cost, LEAST_COST));
    out.push_back({least, cost, index, from, to});
  };
  const int stepwise = std::min(choice.stepwise, choice.wanted);
  for (int tier = 0; tier < stepwise; ++tier) add(tier, tier + 1);
  if (choice.wanted <= stepwise) return;
  const int above = std::clamp(choice.above, stepwise + 1, choice.wanted);
  add(stepwise, above);
  for (int tier = above; tier < choice.wanted; ++tier) add(tier, tier + 1);
}

void fit(std::vector<TierChoice>& choices, double room) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    TierChoice& choice = choices[i];
    choice.chosen = choice.resting ? std::min(choice.held, choice.wanted) : 0;
    room -= costAt(choice, choice.chosen);
    if (!choice.resting) addSteps(choice, i, steps);
  }
  std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) {
    if (a.priority != b.priority) return a.priority > b.priority;
    return a.index != b.index ? a.index < b.index : a.from < b.from;
  });
  for (const Step& step : steps) {
    TierChoice& choice = choices[step.index];
    if (choice.chosen != step.from || step.cost > room) continue;
    choice.chosen = step.to;
    room -= step.cost;
  }
}

}  // namespace

int tierWithin(const TierChoice& choice, int finest, double tolerance) {
  int wanted = 0;
  while (wanted < finest && errorAt(choice, wanted) > tolerance) ++wanted;
  const int held = std::min(choice.held, finest);
  if (wanted < held && errorAt(choice, held - 1) > HYSTERESIS * tolerance) return held;
  return wanted;
}

TierAllocation allocateTiers(std::vector<TierChoice>& choices, double room, double tolerance) {
  TierAllocation out;
  for (TierChoice& choice : choices) {
    choice.chosen = choice.wanted;
    out.wanted += costAt(choice, choice.chosen);
  }
  if (out.wanted > room) fit(choices, room);
  for (const TierChoice& choice : choices) {
    const double error = errorAt(choice, choice.chosen);
    out.cost += costAt(choice, choice.chosen);
    out.largest = std::max(out.largest, error);
    if (choice.scale > 0.0) out.largest_metres = std::max(out.largest_metres, error / choice.scale);
    out.over += error > tolerance ? 1 : 0;
    out.held_back += choice.chosen < choice.wanted ? 1 : 0;
    ++out.counts[static_cast<std::size_t>(choice.chosen)];
  }
  return out;
}

}  // namespace vegetation_sim
