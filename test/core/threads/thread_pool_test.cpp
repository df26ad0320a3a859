// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/threads/thread_pool.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <stdexcept>
#include <vector>

#include "sanitized.h"
#include "thread_limit.h"

namespace vegetation_sim {
namespace {

TEST(ThreadPool, EveryPartRunsOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    for (const std::size_t parts : {0u, 1u, 2u, 7u, 100u}) {
      std::vector<int> calls(parts, 0);
      for (int round = 0; round < 20; ++round) pool.run(parts, [&](std::size_t p) { ++calls[p]; });
      EXPECT_EQ(calls, std::vector<int>(parts, 20)) << threads << " threads";
    }
  }
}

TEST(ThreadPool, APartStaysOnItsThread) {
  ThreadPool pool(4);
  std::vector<std::set<std::thread::id>> threads(8);
  for (int round = 0; round < 50; ++round)
    pool.run(threads.size(),
             [&](std::size_t part) { threads[part].insert(std::this_thread::get_id()); });
  std::set<std::thread::id> all;
  for (std::size_t part = 0; part < threads.size(); ++part) {
    EXPECT_EQ(threads[part].size(), 1u);
    EXPECT_EQ(threads[part], threads[part % pool.size()]);
    all.insert(threads[part].begin(), threads[part].end());
  }
  EXPECT_EQ(all.size(), pool.size());
}

TEST(ThreadPool, RangesCoverAllItemsOnce) {
  for (const std::size_t count : {0u, 1u, 3u, 1000u}) {
    ThreadPool pool(3);
    std::vector<int> calls(count, 0);
    pool.runRanges(count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++calls[i];
    });
    EXPECT_EQ(calls, std::vector<int>(count, 1));
  }
}

TEST(ThreadPool, AnExceptionReachesTheCallerAndThePoolGoesOn) {
  ThreadPool pool(3);
  const auto fail = [](std::size_t part) {
    if (part == 4) throw std::runtime_error("part 4");
  };
  EXPECT_THROW(pool.run(6, fail), std::runtime_error);
  int calls = 0;
  pool.run(1, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 1);
  EXPECT_THROW(pool.run(6, fail), std::runtime_error);
}

TEST(ThreadPoolDeathTest, WithoutThreadsTheCallerDoesAllParts) {
  if (SANITIZED) return;                                 // a sanitizer needs the address space
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // no cached stacks
  EXPECT_EXIT(
      {
        exhaustThreads();
        ThreadPool pool(4);
        int calls = 0;
        pool.run(64, [&](std::size_t) { ++calls; });
        std::_Exit(pool.size() == 1 && calls == 64 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace vegetation_sim
