// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/hashed_cache.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

// The oldest entry is removed, whatever its hash.
TEST(HashedCache, ForgetsTheOldest) {
  HashedCache<int> cache;
  for (int i = 0; i < 12; ++i) cache.keep(static_cast<std::uint64_t>(1000 - i), i);
  for (int i = 0; i < 12; ++i) {
    const int* found = cache.find(static_cast<std::uint64_t>(1000 - i));
    ASSERT_EQ(found != nullptr, i >= 4) << i;
    if (found) {
      EXPECT_EQ(*found, i);
    }
  }
}

TEST(HashedCache, ARepeatedEntryIsTheNewest) {
  HashedCache<int> cache;
  cache.keep(1, 10);
  cache.keep(2, 20);
  EXPECT_FALSE(cache.isNewest(1));
  cache.keep(1, 10);
  EXPECT_TRUE(cache.isNewest(1));
  EXPECT_EQ(*cache.find(2), 20);
}

}  // namespace
}  // namespace vegetation_sim
