// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <fstream>

#include "sanitized.h"

namespace vegetation_sim {
namespace {

/// Runs 64 parts and returns the number of parts that were run exactly once.
int countRunOnce() {
  std::vector<std::atomic<int>> runs(64);
  runInParallel(runs.size(), [&](std::size_t part) { ++runs[part]; });
  int out = 0;
  for (const auto& count : runs) out += count == 1;
  return out;
}

TEST(Parallel, EachPartIsRunOnce) {
  EXPECT_EQ(countRunOnce(), 64);
  runInParallel(0, [](std::size_t) { FAIL(); });
}

// Leaves no address space for the stacks of threads.
void exhaustThreads() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t limit = pages * 4096 + (1u << 20);
  const rlimit all{limit, limit};
  setrlimit(RLIMIT_AS, &all);
}

TEST(ParallelDeathTest, WithoutThreadsTheCallerDoesAllParts) {
  if (SANITIZED) GTEST_SKIP() << "a sanitizer needs the address space";
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // no cached stacks
  EXPECT_EXIT(
      {
        exhaustThreads();
        bool refused = false;
        try {
          std::thread([] {}).join();
        } catch (const std::system_error&) {
          refused = true;
        }
        std::_Exit(refused && countRunOnce() == 64 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace vegetation_sim
