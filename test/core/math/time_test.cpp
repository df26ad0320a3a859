// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/time.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds UNIX_TIME = 1790000000123456789;

TEST(TickGrid, EveryTickIsFoundAgainAtItsTime) {
  const Random random(1);
  for (const int rate : {1, 3, 7, 30, 60, 240, 999, 1000, 44100, 999983, 1000000}) {
    const TickGrid grid(rate);
    const std::int64_t unix_tick = grid.tickAt(UNIX_TIME);
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const auto offset = static_cast<std::int64_t>(random.bits(i) % 4000000) - 2000000;
      for (const std::int64_t k : {offset, unix_tick + offset, -unix_tick + offset}) {
        ASSERT_EQ(grid.tickAt(grid.timeOf(k)), k) << rate << " Hz";
        ASSERT_EQ(grid.tickAt(grid.timeOf(k) - 1), k - 1) << rate << " Hz";
      }
    }
  }
}

TEST(TickGrid, TicksAreNeverLateByANanosecond) {
  const TickGrid grid(240);
  for (std::int64_t k = -1000; k <= 1000; ++k) {
    const auto late = grid.timeOf(k) * 240 - k * NANOSECONDS_PER_SECOND;  // [ns / 240]
    ASSERT_GE(late, 0);
    ASSERT_LT(late, 240);
  }
}

TEST(TickGrid, DoesNotDriftInAYear) {
  const TickGrid grid(240);
  constexpr std::int64_t YEAR = 365LL * 24 * 3600;
  EXPECT_EQ(grid.timeOf(240 * YEAR), YEAR * NANOSECONDS_PER_SECOND);
}

TEST(TickGrid, RefusesARateItCannotKeep) {
  EXPECT_THROW(TickGrid(0), std::invalid_argument);
  EXPECT_THROW(TickGrid(1000001), std::invalid_argument);
  try {
    TickGrid grid(-5);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "tick rate = -5 Hz is outside 1 to 1000000");
  }
}

TEST(Seconds, KeepNanosecondsAtUnixTimes) {
  EXPECT_EQ(secondsBetween(UNIX_TIME, UNIX_TIME + 1), 1e-9);
  EXPECT_EQ(secondsBetween(UNIX_TIME + 500000000, UNIX_TIME), -0.5);
  EXPECT_EQ(fromSeconds(1.5e-9), 2);
  EXPECT_EQ(fromSeconds(-0.25), -250000000);
}

}  // namespace
}  // namespace vegetation_sim
