// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

/// Inputs that did not do what they should.
struct QueueLosses {
  std::uint64_t late{0};  ///< recorded events that came after the tick they are stamped with
  std::uint64_t lost{0};  ///< events that found no room to wait
};

/// Warns on /diagnostics of losses since the last report.
void warnOfLosses(diagnostic_updater::DiagnosticStatusWrapper& status, const QueueLosses& now,
                  const QueueLosses& reported);
/// Warns on the node's console of losses that are not in `told`, and puts them there.
void warnOfLosses(const char* node, const QueueLosses& losses, QueueLosses& published);

/// Accepted inputs of a node wait here for their tick: live ones as events that get the stamp of
/// the tick at which they are applied, in a replay the recorded ones, applied at their own ticks.
/// Bounded, whatever comes in. @tparam Event a message with a header.
template <class Event>
class EventQueue {
 public:
  static constexpr std::size_t MOST_WAITING = 10000;

  explicit EventQueue(bool replay) : replay_(replay) {}

  bool replay() const { return replay_; }
  /// A live input, already checked; its stamp says when, zero: at the next tick. Without effect in
  /// a replay. False: there is no room, it is lost and counted.
  bool add(Event event) {
    if (replay_) return true;
    if (waiting_.size() >= MOST_WAITING) {
      ++losses_.lost;
      return false;
    }
    waiting_.push_back(std::move(event));
    return true;
  }
  /// A recorded event; ignored live, since it is the node's own.
  void addRecorded(const Event& event) {
    if (!replay_) return;
    if (waiting_.size() >= MOST_WAITING) {
      waiting_.pop_front();
      ++losses_.lost;
    }
    waiting_.push_back(event);
  }
  std::size_t room() const { return MOST_WAITING - waiting_.size(); }

  /// Events that take effect at the tick `stamp`, in order, stamped with it.
  std::vector<Event> take(Nanoseconds stamp) {
    std::vector<Event> out;
    std::deque<Event> later;
    for (Event& event : waiting_) {
      const Nanoseconds own = fromMsg(event.header.stamp);
      if (own > stamp) {
        later.push_back(std::move(event));
        continue;
      }
      if (replay_ && own < stamp) ++losses_.late;
      event.header.stamp = toStamp(stamp);
      out.push_back(std::move(event));
    }
    waiting_ = std::move(later);
    return out;
  }
  /// Forgets events for which `is_void(event)` is true.
  template <class Test>
  void forget(Test is_void) {
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), is_void), waiting_.end());
  }
  /// Calls `visit(event)` for each that waits.
  template <class Visit>
  void each(Visit visit) const {
    for (const Event& event : waiting_) visit(event);
  }
  const QueueLosses& losses() const { return losses_; }

 private:
  bool replay_;
  QueueLosses losses_;
  std::deque<Event> waiting_;
};

}  // namespace vegetation_sim
