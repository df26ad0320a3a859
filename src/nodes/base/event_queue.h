// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "nodes/base/client_shares.h"
#include "ros/services/stamp_limits.h"
#include "ros/time/warning_interval.h"
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
/// Warns on the console of a node of losses that are new.
class LossWarnings {
 public:
  void warn(const char* node, const QueueLosses& losses);

 private:
  QueueLosses known_;
  WarningInterval late_, lost_;
};

/// @throws InvalidInput, which says that there is no room, unless `own` and `more` are within
/// `share` together.
void requireShare(const std::string& what, std::size_t own, std::size_t more, std::size_t share);

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
/// queue is bounded, and a client may fill half of what the others leave of it (shareOf()). An
/// event that is accepted stays, since its sender and the journal count on it.
/// @tparam EventType has a stamp; zero: the next tick.
/// @tparam MessageType in which events are published.
template <class EventType, class MessageType = EventType>
class EventQueue {
 public:
  using Event = EventType;
  using Message = MessageType;
  static constexpr std::size_t MOST_WAITING = 20000;
  /// Live inputs for later stamps fill this much of the queue at most, so that they cannot close it
  /// to requests for the next tick.
  static constexpr std::size_t MOST_AHEAD = MOST_WAITING / 2;
  /// The share of a client while no other has inputs that wait.
  static constexpr std::size_t MOST_OF_CLIENT = MOST_WAITING / 2;
  static constexpr std::size_t MOST_AHEAD_OF_CLIENT = MOST_AHEAD / 2;

  /// @param client names whose input is added: the node that sends it, which the events of a
  /// snapshot do not tell. If it is empty, or null, the input is the node's own.
  explicit EventQueue(bool replay, const std::string* client = nullptr)
      : replay_(replay), client_(client) {}

  /// Calls `observe(event)` for each live input that add() accepts from now on.
  void observe(std::function<void(const Event&)> observe) { observe_ = std::move(observe); }

  /// Sets what an event costs when it is applied: a number in a unit of the node, found without
  /// exceptions.
  void setCost(std::function<std::size_t(const Event&)> cost) { cost_of_ = std::move(cost); }

  bool replay() const { return replay_; }
  /// Adds a live input that has been checked. Its stamp says when it takes effect; zero: at the
  /// next tick. Does nothing in a replay. @return false if the share is full: the input is lost.
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
    waiting_.push_front({event, {}});
    count(waiting_.front());
  }
  /// Adds a recorded event; the oldest is lost if the queue is full. Ignored live, since it is the
  /// node's own.
  void addRecorded(const Event& event) {
    if (!replay_) return;
    if (waiting_.size() >= MOST_WAITING) {
      waiting_.pop_front();
      ++losses_.lost;
    }
    waiting_.push_back({event, {}});
  }
  /// Returns how many live inputs of the client still fit: for the next tick (0), or for a later
  /// stamp.
  std::size_t room(Nanoseconds stamp = 0) const {
    const std::size_t all = restOfShare(client(), MOST_WAITING, all_.useOf(client()));
    if (stamp == 0) return all;
    return std::min(all, restOfShare(client(), MOST_AHEAD, ahead_.useOf(client())));
  }

  static std::string describeFull() {
    return "too many inputs wait already, allowed are " + std::to_string(MOST_OF_CLIENT) +
           " of a client, " + std::to_string(MOST_AHEAD_OF_CLIENT) +
           " of them for later stamps, and half of what other clients leave";
  }

  /// Returns the events that take effect at the tick `stamp`, in order, stamped with it. Recorded
  /// events that come after their own tick are among them and counted as late. Live ones that are
  /// too far ahead of it are lost: their stamps could not be checked before the first tick.
  std::vector<Event> take(Nanoseconds stamp) {
    std::vector<Event> out;
    out.reserve(waiting_.size());
    std::deque<Waiting> later;
    for (Waiting& one : waiting_) {
      const Nanoseconds own = stampOf(one.event);
      if (own > stamp) {
        const bool is_lost = !replay_ && isTooFarAhead(own, stamp);
        losses_.lost += is_lost;
        if (!is_lost) later.push_back(std::move(one));
        continue;
      }
      if (replay_ && own < stamp) ++losses_.late;
      setStamp(one.event, stamp);
      out.push_back(std::move(one.event));
    }
    waiting_ = std::move(later);
    countAll();
    return out;
  }
  /// Drops the events for which `is_void(event)` is true.
  template <class Test>
  void forget(Test is_void) {
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& one) { return is_void(one.event); }),
                   waiting_.end());
    countAll();
  }
  /// Replaces all that waits.
  void restore(const std::vector<Event>& waiting) {
    waiting_.clear();
    for (const Event& event : waiting) waiting_.push_back({event, {}});
    countAll();
  }
  /// Calls `visit(event)` for each event that waits.
  template <class Visit>
  void each(Visit visit) const {
    for (const Waiting& one : waiting_) visit(one.event);
  }
  /// Checks that an input of the client may wait. @param what all such inputs hold, of which
  /// `measure(event)` returns the number in one. @param more the number in the input.
  /// @throws InvalidInput if they are more than the client's share of `most`.
  template <class Measure>
  void checkShare(const std::string& what, std::size_t more, std::size_t most,
                  Measure measure) const {
    SharedUse use;
    for (const Waiting& one : waiting_) {
      const std::size_t size = measure(one.event);
      use.all += size;
      if (one.client == client()) use.own += size;
    }
    requireShare(what, use.own, more, shareOf(client(), most, use));
  }
  /// Does the same for the costs of all inputs. @param more the cost of the input.
  void checkCost(const std::string& what, std::size_t more, std::size_t most) const {
    const SharedUse use = costs_.useOf(client());
    requireShare(what, use.own, more, shareOf(client(), most, use));
  }
  const QueueLosses& losses() const { return losses_; }

 protected:
  struct Waiting {
    Event event;
    std::string client;  ///< that has sent it; empty: the node
  };
  void push(Event event) {
    waiting_.push_back({std::move(event), client()});
    count(waiting_.back());
    report(waiting_.back().event);
  }
  void report(const Event& event) const {
    if (observe_) observe_(event);
  }

  bool replay_;
  QueueLosses losses_;
  std::deque<Waiting> waiting_;

 private:
  const std::string& client() const {
    static const std::string NODE;
    return client_ ? *client_ : NODE;
  }
  void count(const Waiting& one) {
    all_.add(one.client);
    if (stampOf(one.event) != 0) ahead_.add(one.client);
    if (cost_of_) costs_.add(one.client, cost_of_(one.event));
  }
  void countAll() {
    all_.clear();
    ahead_.clear();
    costs_.clear();
    for (const Waiting& one : waiting_) count(one);
  }

  const std::string* client_;
  ClientCounts all_, ahead_;  ///< ahead: waiting for a stamp of their own
  ClientCounts costs_;
  std::function<void(const Event&)> observe_;
  std::function<std::size_t(const Event&)> cost_of_;
};

}  // namespace vegetation_sim
