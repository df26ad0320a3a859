// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/async_tasks.h"

#include <ros/console.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <thread>
#include <utility>

namespace vegetation_sim::view {
namespace {

constexpr std::chrono::milliseconds PATIENCE(500);

}  // namespace

struct AsyncTasks::Desk {
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::function<void()>> waiting;
  std::size_t left{0};
  bool ending{false};
};

AsyncTasks::AsyncTasks() : grabs_manager_(std::make_shared<Desk>()) {
  std::thread([desk = grabs_manager_] { run(*desk); }).detach();
}

AsyncTasks::~AsyncTasks() {
  std::unique_lock<std::mutex> lock(grabs_manager_->mutex);
  grabs_manager_->ending = true;
  grabs_manager_->changed.notify_all();
  grabs_manager_->changed.wait_for(lock, PATIENCE, [this] { return grabs_manager_->left == 0; });
}

void AsyncTasks::add(std::function<void()> task) {
  const std::lock_guard<std::mutex> lock(grabs_manager_->mutex);
  grabs_manager_->waiting.push_back(std::move(task));
  ++grabs_manager_->left;
  grabs_manager_->changed.notify_all();
}

std::size_t AsyncTasks::left() const {
  const std::lock_guard<std::mutex> lock(grabs_manager_->mutex);
  return grabs_manager_->left;
}

void AsyncTasks::run(Desk& desk) {
  std::unique_lock<std::mutex> lock(desk.mutex);
  while (true) {
    desk.changed.wait(lock, [&] { return desk.ending || !desk.waiting.empty(); });
    if (desk.waiting.empty()) return;
    std::function<void()> task = std::move(desk.waiting.front());
    desk.waiting.pop_front();
    lock.unlock();
    try {
      task();
    } catch (const std::exception& error) {
      ROS_ERROR("An errand of rviz ended early: %s", error.what());
    }
    lock.lock();
    --desk.left;
    desk.changed.notify_all();
    lock.unlock();
    task = nullptr;  // whom it holds may end with it, and ask for the lock
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
