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
  HashedCache<int> cache(2);
  cache.keep(1, 10);
  cache.keep(2, 20);
  cache.keep(1, 10);
  cache.keep(3, 30);
  EXPECT_EQ(cache.find(2), nullptr) << "it has become the oldest";
  EXPECT_NE(cache.find(1), nullptr);
}

}  // namespace
}  // namespace vegetation_sim
