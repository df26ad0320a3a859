// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace vegetation_sim {

/// Threads that wait for tasks and do the parts of each together. Which thread does a part is
/// fixed, so parts that keep memory of their own find it in the cache of the same processor.
/// Results do not depend on the number of threads if no part reads what another one writes.
class ThreadPool {
 public:
  /// @param threads with the calling one; there are fewer if the system refuses more.
  explicit ThreadPool(int threads = 1);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  std::size_t size() const { return others_.size() + 1; }
  /// Calls each(part) for all parts below `parts` and returns when all calls have returned;
  /// rethrows one of their exceptions. Part p runs on thread p mod size(). One caller at a time,
  /// and not from within a task.
  void run(std::size_t parts, const std::function<void(std::size_t)>& each);
  /// Splits `count` items into size() ranges and calls each(begin, end) for each that is not empty.
  void runRanges(std::size_t count,
                 const std::function<void(std::size_t begin, std::size_t end)>& each);

 private:
  void wait(std::size_t thread);
  void runParts(std::size_t thread);

  std::vector<std::thread> others_;
  std::mutex mutex_;
  std::condition_variable begin_, end_;
  // Guarded by the mutex; threads read the task without it while it runs.
  const std::function<void(std::size_t)>* task_{nullptr};
  std::size_t parts_{0}, stride_{1};
  std::uint64_t round_{0};
  std::size_t running_{0};
  bool stop_{false};
  std::exception_ptr error_;
};

}  // namespace vegetation_sim
