// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/feedback_budget.h"

#include <algorithm>

namespace vegetation_sim {
namespace {

constexpr int AVERAGED = 10;                    // measurements of a mean, and between two changes
constexpr double ABOVE = 1.05, BELOW = 0.92;    // of the target, between which nothing changes
constexpr double FASTEST = 0.7, RISING = 1.05;  // factors of one change
constexpr double LONGEST = 10.0;  // a longer time counts as this many targets: a stopped process

}  // namespace

double FeedbackBudget::update(double measured, double target) {
  if (!(target > 0.0)) {
    *this = FeedbackBudget();
    return share_;
  }
  const double time = std::min(measured, LONGEST * target);
  mean_ = mean_ > 0.0 ? mean_ + (time - mean_) / AVERAGED : time;
  if (++wait_ < AVERAGED) return share_;
  if (mean_ > ABOVE * target)
    share_ = std::max(LEAST, share_ * std::max(FASTEST, target / mean_));
  else if (mean_ < BELOW * target)
    share_ = std::min(1.0, share_ * RISING);
  else
    return share_;
  wait_ = 0;
  return share_;
}

}  // namespace vegetation_sim
