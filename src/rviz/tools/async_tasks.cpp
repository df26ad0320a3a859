// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/async_tasks.h"

#include <ros/console.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <system_error>
#include <thread>
#include <utility>

namespace vegetation_sim::view {
namespace {

constexpr std::chrono::milliseconds PATIENCE(500);

void runGuarded(const std::function<void()>& task) {
  try {
    task();
  } catch (const std::exception& error) {
    ROS_ERROR("A background task of rviz failed: %s", error.what());
  }
}

}  // namespace

struct AsyncTasks::Queue {
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::function<void()>> waiting;
  std::size_t left{0};
  bool ending{false};
  bool has_thread{true};
};

AsyncTasks::AsyncTasks() : queue_(std::make_shared<Queue>()) {
  try {
    std::thread([queue = queue_] { run(*queue); }).detach();
  } catch (const std::system_error&) {
    queue_->has_thread = false;  // the system has no more; tasks run where they are added
  }
}

AsyncTasks::~AsyncTasks() {
  std::unique_lock<std::mutex> lock(queue_->mutex);
  queue_->ending = true;
  queue_->changed.notify_all();
  queue_->changed.wait_for(lock, PATIENCE, [this] { return queue_->left == 0; });
}

void AsyncTasks::add(std::function<void()> task) {
  if (!queue_->has_thread) return runGuarded(task);
  const std::lock_guard<std::mutex> lock(queue_->mutex);
  queue_->waiting.push_back(std::move(task));
  ++queue_->left;
  queue_->changed.notify_all();
}

std::size_t AsyncTasks::left() const {
  const std::lock_guard<std::mutex> lock(queue_->mutex);
  return queue_->left;
}

void AsyncTasks::run(Queue& queue) {
  std::unique_lock<std::mutex> lock(queue.mutex);
  while (true) {
    queue.changed.wait(lock, [&] { return queue.ending || !queue.waiting.empty(); });
    if (queue.waiting.empty()) return;
    std::function<void()> task = std::move(queue.waiting.front());
    queue.waiting.pop_front();
    lock.unlock();
    runGuarded(task);
    lock.lock();
    --queue.left;
    queue.changed.notify_all();
    lock.unlock();
    task = nullptr;  // its captures may end here and need the lock
    lock.lock();
  }
}

void Answer::give(const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  text_ = text;
}

std::optional<std::string> Answer::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(text_, std::nullopt);
}

}  // namespace vegetation_sim::view
