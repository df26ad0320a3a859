// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <thread>

namespace vegetation_sim {

/// Repeats a task in a thread of its own until it is destroyed.
class Repeating {
 public:
  template <class Task>
  explicit Repeating(Task task)
      : thread_([this, task] {
          while (!stop_) task();
        }) {}
  ~Repeating() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace vegetation_sim
