// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace vegetation_sim {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers that the authors of Philox publish for philox4x32 with 10 rounds.
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t ONES = 0xffffffff;
  EXPECT_EQ(philox({ONES, ONES, ONES, ONES}, {ONES, ONES}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  // Counter and key from the digits of pi.
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, GivesTheSameValueWhateverWasAskedBefore) {
  const Random forward(42), backward(42);
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) sum += forward.uniform(static_cast<std::uint64_t>(i));
  for (int i = 99; i >= 0; --i) sum -= backward.uniform(static_cast<std::uint64_t>(i));
  EXPECT_NEAR(sum, 0.0, 1e-12);  // the order of summation differs
  EXPECT_EQ(forward.bits(7), Random(42).bits(7));
}

TEST(Random, IsUniform) {
  const Random random(5);
  constexpr int COUNT = 100000;
  std::array<int, 10> bins{};
  double mean = 0.0;
  for (int i = 0; i < COUNT; ++i) {
    const double u = random.uniform(static_cast<std::uint64_t>(i));
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 10.0)];
    mean += u / COUNT;
  }
  EXPECT_NEAR(mean, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / COUNT));  // five standard errors
  for (const int bin : bins) EXPECT_NEAR(bin, COUNT / 10, 5.0 * std::sqrt(COUNT * 0.09));
}

TEST(Random, StaysInAGivenInterval) {
  const Random random(6);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double u = random.uniform(i, -3.0, 2.0);
    ASSERT_GE(u, -3.0);
    ASSERT_LT(u, 2.0);
  }
}

TEST(Random, ChildrenShareNoNumbersWithParentOrSiblings) {
  const Random parent(9);
  std::set<std::uint64_t> seen;
  for (std::uint64_t i = 0; i < 100; ++i) {
    seen.insert(parent.bits(i));
    for (std::uint64_t j = 0; j < 100; ++j) seen.insert(parent.child(i).bits(j));
  }
  EXPECT_EQ(seen.size(), 100u + 100u * 100u);
}

TEST(Random, ChildrenAreUncorrelated) {
  // Neighbouring children, the same index: the correlation of N pairs has deviation 1 / sqrt(N).
  const Random parent(11);
  constexpr int COUNT = 20000;
  double correlation = 0.0;
  for (std::uint64_t i = 0; i < COUNT; ++i)
    correlation += (parent.child(i).uniform(3) - 0.5) * (parent.child(i + 1).uniform(3) - 0.5);
  EXPECT_LT(std::fabs(correlation * 12.0 / COUNT), 5.0 / std::sqrt(COUNT));
}

}  // namespace
}  // namespace vegetation_sim
