// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/threads/thread_pool.h"

#include <system_error>

namespace vegetation_sim {

ThreadPool::ThreadPool(int threads) {
  try {
    for (int thread = 1; thread < threads; ++thread)
      others_.emplace_back([this, thread] { wait(static_cast<std::size_t>(thread)); });
  } catch (const std::system_error&) {
    // The system has no more threads; those that exist do all parts.
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  begin_.notify_all();
  for (std::thread& other : others_) other.join();
}

void ThreadPool::wait(std::size_t thread) {
  std::uint64_t done = 0;  // rounds
  for (;;) {
    std::unique_lock<std::mutex> lock(mutex_);
    begin_.wait(lock, [&] { return stop_ || round_ != done; });
    if (stop_) return;
    done = round_;
    lock.unlock();
    runParts(thread);
    lock.lock();
    if (--running_ == 0) end_.notify_one();
  }
}

void ThreadPool::runParts(std::size_t thread) {
  try {
    for (std::size_t part = thread; part < parts_; part += stride_) (*task_)(part);
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    error_ = std::current_exception();
  }
}

void ThreadPool::run(std::size_t parts, const std::function<void(std::size_t)>& each) {
  if (others_.empty() || parts < 2) {
    for (std::size_t part = 0; part < parts; ++part) each(part);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    task_ = &each;
    parts_ = parts;
    stride_ = size();
    error_ = nullptr;
    running_ = others_.size();
    ++round_;
  }
  begin_.notify_all();
  runParts(0);
  std::unique_lock<std::mutex> lock(mutex_);
  end_.wait(lock, [&] { return running_ == 0; });
  if (error_) std::rethrow_exception(error_);
}

void ThreadPool::runRanges(std::size_t count,
                           const std::function<void(std::size_t begin, std::size_t end)>& each) {
  const std::size_t ranges = size();
  run(ranges, [&](std::size_t range) {
    const std::size_t begin = count * range / ranges, end = count * (range + 1) / ranges;
    if (begin < end) each(begin, end);
  });
}

}  // namespace vegetation_sim
