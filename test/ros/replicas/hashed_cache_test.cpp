// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/hashed_cache.h"

#include <gtest/gtest.h>

namespace vegetation_sim {
namespace {

// The oldest entry is removed, whatever its hash.
TEST(HashedCache, ForgetsTheOldest) {
  HashedCache<int> heard;
  for (int i = 0; i < 12; ++i) heard.keep(static_cast<std::uint64_t>(1000 - i), i);
  for (int i = 0; i < 12; ++i) {
    const int* found = heard.find(static_cast<std::uint64_t>(1000 - i));
    ASSERT_EQ(found != nullptr, i >= 4) << i;
    if (found) {
      EXPECT_EQ(*found, i);
    }
  }
}

TEST(HashedCache, WhatComesAgainIsTheNewest) {
  HashedCache<int> heard;
  heard.keep(1, 10);
  heard.keep(2, 20);
  EXPECT_FALSE(heard.isNewest(1));
  heard.keep(1, 10);
  EXPECT_TRUE(heard.isNewest(1));
  EXPECT_EQ(*heard.find(2), 20);
}

}  // namespace
}  // namespace vegetation_sim
