// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace vegetation_sim::view {

/// Runs tasks one after the other in a thread beside the render thread, so that a slow service does
/// not block rendering; in the render thread if the system has no more threads. A task owns what it
/// uses, since it may outlive its sender.
class AsyncTasks {
 public:
  AsyncTasks();
  /// Waits at most half a second; unfinished tasks continue in the background.
  ~AsyncTasks();
  AsyncTasks(const AsyncTasks&) = delete;
  AsyncTasks& operator=(const AsyncTasks&) = delete;

  void add(std::function<void()> task);
  /// Returns the number of tasks that wait or run.
  std::size_t left() const;

 private:
  struct Queue;
  static void run(Queue& queue);

  std::shared_ptr<Queue> queue_;
};

/// Message that a task returns.
class Answer {
 public:
  void give(const std::string& text);
  /// Returns the message since the last call, or nothing.
  std::optional<std::string> take();

 private:
  std::mutex mutex_;
  std::optional<std::string> text_;
};

}  // namespace vegetation_sim::view
