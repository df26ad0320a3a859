// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/async_tasks.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <future>
#include <stdexcept>

#include "sanitized.h"
#include "thread_limit.h"

namespace vegetation_sim::view {
namespace {

TEST(AsyncTasks, RunInOrderAlsoAfterOneThatThrows) {
  AsyncTasks tasks;
  std::promise<int> result;
  int calls = 0;
  tasks.add([&] { ++calls; });
  tasks.add([] { throw std::runtime_error("no such service"); });
  tasks.add([&] { result.set_value(++calls); });
  EXPECT_EQ(result.get_future().get(), 2);
}

TEST(AsyncTasksDeathTest, WithoutAThreadTheCallerRunsThem) {
  if (SANITIZED) return;                                 // a sanitizer needs the address space
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // no cached stacks
  EXPECT_EXIT(
      {
        exhaustThreads();
        AsyncTasks tasks;
        int calls = 0;
        tasks.add([&] { ++calls; });
        tasks.add([] { throw std::runtime_error("no such service"); });
        tasks.add([&] { ++calls; });
        std::_Exit(calls == 2 && tasks.left() == 0 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace vegetation_sim::view
