// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/errands.h"

#include <utility>

namespace vegetation_sim::view {

Errands::~Errands() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Errands::add(std::function<void()> errand) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    errands_.push_back(std::move(errand));
  }
  changed_.notify_one();
}

std::size_t Errands::left() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return errands_.size();
}

void Errands::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !errands_.empty(); });
    if (errands_.empty()) return;
    const std::function<void()> errand = errands_.front();
    lock.unlock();
    errand();
    lock.lock();
    errands_.pop_front();
  }
}

}  // namespace vegetation_sim::view
