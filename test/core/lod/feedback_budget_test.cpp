// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/feedback_budget.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

constexpr double TARGET = 0.05;  // [s]

/// A frame takes 10 ms, and 0.4 ms for each of `items` that the budget lets through, and noise.
double frameTime(double items, double share, std::uint64_t frame) {
  return (0.01 + 4e-4 * items * share) * Random(7).uniform(frame, 0.8, 1.2);
}

// N7: the measured time stays within a tenth of its target for 16 to 1024 items, and what is drawn
// stands still.
TEST(FeedbackBudget, KeepsTheTargetForAnyNumberOfItems) {
  for (const double items : {16.0, 64.0, 256.0, 1024.0}) {
    FeedbackBudget budget;
    double least = 1.0, most = 0.0, sum = 0.0;
    for (std::uint64_t frame = 0; frame < 2000; ++frame) {
      const double time = frameTime(items, budget.share(), frame);
      budget.update(time, TARGET);
      if (frame < 1000) continue;
      sum += time / 1000.0;
      least = std::min(least, budget.share());
      most = std::max(most, budget.share());
    }
    if (items < 100.0)
      EXPECT_EQ(most, 1.0) << items;  // all fit
    else
      EXPECT_NEAR(sum, TARGET, 0.1 * TARGET) << items;
    EXPECT_LT(most / least, 1.25) << items;
  }
}

TEST(FeedbackBudget, RecoversWhenTheLoadIsGone) {
  FeedbackBudget budget;
  for (int i = 0; i < 500; ++i) budget.update(0.3, TARGET);
  EXPECT_EQ(budget.share(), FeedbackBudget::LEAST);
  for (int i = 0; i < 2000; ++i) budget.update(0.01, TARGET);
  EXPECT_EQ(budget.share(), 1.0);
}

TEST(FeedbackBudget, WithoutATargetIsTheWholeBudget) {
  FeedbackBudget budget;
  for (int i = 0; i < 100; ++i) budget.update(0.3, TARGET);
  EXPECT_LT(budget.share(), 1.0);
  EXPECT_EQ(budget.update(0.3, 0.0), 1.0);
}

// A process that was stopped for an hour is no load.
TEST(FeedbackBudget, ForgetsASingleLongFrame) {
  FeedbackBudget budget;
  for (int i = 0; i < 100; ++i) budget.update(0.03, TARGET);
  budget.update(3600.0, TARGET);
  for (int i = 0; i < 300; ++i) budget.update(0.03, TARGET);
  EXPECT_EQ(budget.share(), 1.0);
}

}  // namespace
}  // namespace vegetation_sim
