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

struct Errands::Desk {
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::deque<std::function<void()>> waiting;
  std::size_t left{0};
  bool ending{false};
};

Errands::Errands() : desk_(std::make_shared<Desk>()) {
  std::thread([desk = desk_] { run(*desk); }).detach();
}

Errands::~Errands() {
  std::unique_lock<std::mutex> lock(desk_->mutex);
  desk_->ending = true;
  desk_->changed.notify_all();
  desk_->changed.wait_for(lock, PATIENCE, [this] { return desk_->left == 0; });
}

void Errands::add(std::function<void()> errand) {
  const std::lock_guard<std::mutex> lock(desk_->mutex);
  desk_->waiting.push_back(std::move(errand));
  ++desk_->left;
  desk_->changed.notify_all();
}

std::size_t Errands::left() const {
  const std::lock_guard<std::mutex> lock(desk_->mutex);
  return desk_->left;
}

void Errands::run(Desk& desk) {
  std::unique_lock<std::mutex> lock(desk.mutex);
  while (true) {
    desk.changed.wait(lock, [&] { return desk.ending || !desk.waiting.empty(); });
    if (desk.waiting.empty()) return;
    std::function<void()> errand = std::move(desk.waiting.front());
    desk.waiting.pop_front();
    lock.unlock();
    try {
      errand();
    } catch (const std::exception& error) {
      ROS_ERROR("An errand of rviz ended early: %s", error.what());
    }
    lock.lock();
    --desk.left;
    desk.changed.notify_all();
    lock.unlock();
    errand = nullptr;  // whom it holds may end with it, and ask for the lock
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
