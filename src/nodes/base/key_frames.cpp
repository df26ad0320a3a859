// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/key_frames.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vegetation_sim {
namespace {

constexpr int FINEST = 7;  // number of times the wanted period can be doubled
static_assert(FINEST < static_cast<int>(MAX_TIERS));

}  // namespace

KeyFrames::KeyFrames(double period, int rate, int budget)
    : ticks_(std::max(1, static_cast<int>(period * rate))), rate_(rate), budget_(budget) {}

std::int64_t KeyFrames::ticks() const {
  return std::int64_t{ticks_} << bisection_;
}

double KeyFrames::period() const {
  return static_cast<double>(ticks()) / rate_;
}

bool KeyFrames::isDue(std::int64_t tick) {
  return std::exchange(demanded_, false) || tick % ticks() == 0;
}

void KeyFrames::sent(std::uint64_t bytes) {
  std::vector<TierChoice> choice(1);
  choice[0].held = FINEST - bisection_;
  for (int tier = 0; tier <= FINEST; ++tier) {
    const auto place = static_cast<std::size_t>(tier);
    const double seconds = static_cast<double>(std::int64_t{ticks_} << (FINEST - tier)) / rate_;
    choice[0].error[place] = static_cast<float>(seconds);
    choice[0].cost[place] = static_cast<float>(static_cast<double>(bytes) / seconds);
  }
  choice[0].stepwise = choice[0].wanted = FINEST;
  balance_ = allocateTiers(choice, budget_, 0.0);
  bisection_ = FINEST - choice[0].chosen;
}

}  // namespace vegetation_sim
