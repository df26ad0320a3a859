// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/base/closable_queue.h"

#include <boost/make_shared.hpp>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

namespace vegetation_sim {

/// Counts the threads that are inside the queue or a callback of it.
struct ClosableQueue::Gate {
  /// Returns whether the queue is open. If so, leave() has to follow.
  bool enter() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (open) ++inside;
    return open;
  }
  void leave() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (--inside == 0) empty.notify_all();
  }
  void close() {
    std::unique_lock<std::mutex> lock(mutex);
    open = false;
    empty.wait(lock, [this] { return inside == 0; });
  }

  std::mutex mutex;
  std::condition_variable empty;
  bool open{true};
  int inside{0};
};

/// Is inside a gate while it exists, if the gate is open.
class ClosableQueue::Visit {
 public:
  explicit Visit(Gate& gate) : gate_(gate), inside_(gate.enter()) {}
  ~Visit() {
    if (inside_) gate_.leave();
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;
  explicit operator bool() const { return inside_; }

 private:
  Gate& gate_;
  const bool inside_;
};

/// A callback that does nothing once the queue is closed.
class ClosableQueue::Guarded final : public ros::CallbackInterface {
 public:
  Guarded(ros::CallbackInterfacePtr callback, std::shared_ptr<Gate> gate)
      : callback_(std::move(callback)), gate_(std::move(gate)) {}

  CallResult call() override {
    const Visit visit(*gate_);
    return visit ? callback_->call() : Invalid;
  }
  bool ready() override {
    const Visit visit(*gate_);
    return !visit || callback_->ready();
  }

 private:
  const ros::CallbackInterfacePtr callback_;
  const std::shared_ptr<Gate> gate_;
};

ClosableQueue::ClosableQueue(ros::CallbackQueueInterface& target)
    : target_(target), gate_(std::make_shared<Gate>()) {}

void ClosableQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  const Visit visit(*gate_);
  if (visit) target_.addCallback(boost::make_shared<Guarded>(callback, gate_), owner);
}

void ClosableQueue::removeByID(std::uint64_t owner) {
  const Visit visit(*gate_);
  if (visit) target_.removeByID(owner);
}

void ClosableQueue::close() {
  gate_->close();
}

ClosableQueue& makeClosableQueue(ros::CallbackQueueInterface& target) {
  static std::mutex mutex;
  static auto& queues = *new std::deque<ClosableQueue>;
  const std::lock_guard<std::mutex> lock(mutex);
  return queues.emplace_back(target);
}

}  // namespace vegetation_sim
