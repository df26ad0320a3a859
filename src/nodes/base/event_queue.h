// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

/// Counts of inputs that were late or lost.
struct QueueLosses {
  std::uint64_t late{0};  ///< recorded events that came after the tick they are stamped with
  std::uint64_t lost{0};  ///< events that found the queue full
};

/// Warns on /diagnostics of losses since the last report.
void warnOfLosses(diagnostic_updater::DiagnosticStatusWrapper& status, const QueueLosses& now,
                  const QueueLosses& reported);
/// Warns on the node's console of losses that are not yet in `published`, and adds them to it.
void warnOfLosses(const char* node, const QueueLosses& losses, QueueLosses& published);

/// Stamp and message of an event. An event that is not itself a message has its own overloads.
template <class Event>
Nanoseconds stampOf(const Event& event) {
  return fromMsg(event.header.stamp);
}
template <class Event>
void setStamp(Event& event, Nanoseconds stamp) {
  event.header.stamp = toStamp(stamp);
}
template <class Event>
const Event& eventToMsg(const Event& event) {
  return event;
}
template <class Event>
const Event& eventFromMsg(const Event& message) {
  return message;
}

/// Accepted inputs of a node wait here for their tick. Live inputs become events that get the stamp
/// of the tick at which they are applied; a replay applies recorded events at their own ticks. The
/// queue is bounded. @tparam EventType has a stamp; zero: the next tick.
/// @tparam MessageType in which events are published.
template <class EventType, class MessageType = EventType>
class EventQueue {
 public:
  using Event = EventType;
  using Message = MessageType;
  static constexpr std::size_t MOST_WAITING = 10000;
  /// Live inputs for later stamps fill this much of the queue at most, so that they cannot close it
  /// to requests for the next tick.
  static constexpr std::size_t MOST_AHEAD = MOST_WAITING / 2;

  explicit EventQueue(bool replay) : replay_(replay) {}

  /// Calls `observe(event)` for each live input that add() accepts from now on.
  void observe(std::function<void(const Event&)> observe) { observe_ = std::move(observe); }

  /// Sets what an event costs when it is applied: a whole number in a unit of the node, found
  /// without exceptions.
  void setCost(std::function<double(const Event&)> cost) { cost_of_ = std::move(cost); }
  /// Sum of the costs of the live inputs that wait.
  double cost() const { return cost_; }

  bool replay() const { return replay_; }
  /// Adds a live input that has been checked. Its stamp says when it takes effect; zero: at the
  /// next tick. Does nothing in a replay. @return false if the queue is full: the input is lost.
  bool add(Event event) {
    if (replay_) return true;
    if (room(stampOf(event)) == 0) {
      ++losses_.lost;
      return false;
    }
    push(std::move(event));
    return true;
  }
  /// Adds a live input before all that wait, even if the queue is full.
  void addFirst(const Event& event) {
    if (replay_) return;
    cost_ += costOf(event);
    waiting_.push_front(event);
  }
  /// Adds a recorded event; the oldest is lost if the queue is full. Ignored live, since it is the
  /// node's own.
  void addRecorded(const Event& event) {
    if (!replay_) return;
    if (room() == 0) {
      waiting_.pop_front();
      ++losses_.lost;
    }
    waiting_.push_back(event);
  }
  /// Returns how many live inputs still fit: for the next tick (0), or for a later stamp.
  std::size_t room(Nanoseconds stamp = 0) const {
    const std::size_t all = MOST_WAITING - std::min(MOST_WAITING, waiting_.size());
    return stamp == 0 ? all : std::min(all, MOST_AHEAD - std::min(MOST_AHEAD, ahead_));
  }

  static std::string describeFull() {
    return "too many inputs wait already, allowed are " + std::to_string(MOST_WAITING) + ", and " +
           std::to_string(MOST_AHEAD) + " for later stamps";
  }

  /// Returns the events that take effect at the tick `stamp`, in order, stamped with it. Recorded
  /// events that come after their own tick are among them and counted as late.
  std::vector<Event> take(Nanoseconds stamp) {
    std::vector<Event> out;
    out.reserve(waiting_.size());
    std::deque<Event> later;
    for (Event& event : waiting_) {
      const Nanoseconds own = stampOf(event);
      if (own > stamp) {
        later.push_back(std::move(event));
        continue;
      }
      if (replay_ && own < stamp) ++losses_.late;
      if (!replay_) cost_ -= costOf(event);
      setStamp(event, stamp);
      out.push_back(std::move(event));
    }
    waiting_ = std::move(later);
    ahead_ = waiting_.size();
    return out;
  }
  /// Drops the events for which `is_void(event)` is true.
  template <class Test>
  void forget(Test is_void) {
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), is_void), waiting_.end());
    ahead_ = static_cast<std::size_t>(std::count_if(
        waiting_.begin(), waiting_.end(), [](const Event& event) { return stampOf(event) != 0; }));
    addUp();
  }
  /// Replaces all that waits.
  void restore(const std::vector<Event>& waiting) {
    waiting_.assign(waiting.begin(), waiting.end());
    forget([](const Event&) { return false; });  // counts those ahead, and the costs
  }
  /// Calls `visit(event)` for each event that waits.
  template <class Visit>
  void each(Visit visit) const {
    for (const Event& event : waiting_) visit(event);
  }
  const QueueLosses& losses() const { return losses_; }

 protected:
  void push(Event event) {
    ahead_ += stampOf(event) != 0;
    cost_ += costOf(event);
    waiting_.push_back(std::move(event));
    report(waiting_.back());
  }
  void report(const Event& event) const {
    if (observe_) observe_(event);
  }

  bool replay_;
  QueueLosses losses_;
  std::deque<Event> waiting_;
  std::size_t ahead_{0};  ///< waiting for a stamp of their own

 private:
  double costOf(const Event& event) const { return cost_of_ ? cost_of_(event) : 0.0; }
  void addUp() {
    cost_ = 0.0;
    if (cost_of_ && !replay_)
      for (const Event& event : waiting_) cost_ += cost_of_(event);
  }

  std::function<void(const Event&)> observe_;
  std::function<double(const Event&)> cost_of_;
  double cost_{0.0};
};

}  // namespace vegetation_sim
