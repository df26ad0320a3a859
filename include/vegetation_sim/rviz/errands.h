// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace vegetation_sim::view {

/// Runs errands one after the other beside the render thread: a service that answers late must not
/// stop the picture. An errand must not throw.
class Errands {
 public:
  Errands() : thread_([this] { run(); }) {}
  /// Waits until all are done.
  ~Errands();
  Errands(const Errands&) = delete;
  Errands& operator=(const Errands&) = delete;

  void add(std::function<void()> errand);
  /// Those that wait or run.
  std::size_t left() const;

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> errands_;
  bool ending_{false};
  std::thread thread_;  // the last: it uses the others
};

}  // namespace vegetation_sim::view
