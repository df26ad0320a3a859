// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace vegetation_sim::view {

/// Runs errands one after the other beside the render thread: a service that answers late must not
/// stop the picture. An errand holds what it uses: it may outlive whoever sent it.
class AsyncTasks {
 public:
  AsyncTasks();
  /// Waits half a second at most; what is not done by then goes on beside.
  ~AsyncTasks();
  AsyncTasks(const AsyncTasks&) = delete;
  AsyncTasks& operator=(const AsyncTasks&) = delete;

  void add(std::function<void()> task);
  /// Those that wait or run.
  std::size_t left() const;

 private:
  struct Desk;
  static void run(Desk& desk);

  std::shared_ptr<Desk> grabs_manager_;
};

/// What an errand brings back, in words.
class Answer {
 public:
  void give(const std::string& text);
  /// What was given since it was asked last; none: nothing.
  std::optional<std::string> take();

 private:
  std::mutex mutex_;
  std::optional<std::string> text_;
};

}  // namespace vegetation_sim::view
