// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <iterator>
#include <utility>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Messages that wait until a node that runs behind the clock reaches their stamps. Those that are
/// due are taken in the order of their arrival; one of a far future does not hold back the others.
/// The oldest is dropped and counted if too many wait.
template <class Message>
class DelayBuffer {
 public:
  static constexpr std::size_t MOST_WAITING = 2000;

  void add(Nanoseconds stamp, Message message) {
    if (waiting_.size() >= MOST_WAITING) {
      waiting_.pop_front();
      ++lost_;
    }
    waiting_.emplace_back(stamp, std::move(message));
  }
  /// Removes the messages up to `stamp`, in order, and calls `take(stamp, message)` for each.
  template <class Take>
  void take(Nanoseconds stamp, Take take) {
    const auto later = std::stable_partition(waiting_.begin(), waiting_.end(),
                                             [&](const auto& one) { return one.first <= stamp; });
    const std::deque<std::pair<Nanoseconds, Message>> due(std::make_move_iterator(waiting_.begin()),
                                                          std::make_move_iterator(later));
    waiting_.erase(waiting_.begin(), later);
    for (const auto& one : due) take(one.first, one.second);
  }
  /// Drops the messages of later stamps, because time jumped back to `now`.
  void forgetLater(Nanoseconds now) {
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                  [now](const auto& one) { return one.first > now; }),
                   waiting_.end());
  }
  /// Returns whether a message up to `stamp` waits.
  bool has(Nanoseconds stamp) const {
    return std::any_of(waiting_.begin(), waiting_.end(),
                       [stamp](const auto& one) { return one.first <= stamp; });
  }
  std::size_t size() const { return waiting_.size(); }
  std::uint64_t lost() const { return lost_; }

 private:
  std::deque<std::pair<Nanoseconds, Message>> waiting_;
  std::uint64_t lost_{0};
};

}  // namespace vegetation_sim
