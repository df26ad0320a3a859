// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// What was told of moments to which a node that stays behind the clock has not come yet; in the
/// order in which it came. Bounded: where there is no room, the oldest is lost and counted.
template <class Told>
class DelayBuffer {
 public:
  static constexpr std::size_t MOST_WAITING = 2000;

  void add(Nanoseconds stamp, Told published) {
    if (waiting_.size() >= MOST_WAITING) {
      waiting_.pop_front();
      ++lost_;
    }
    waiting_.emplace_back(stamp, std::move(published));
  }
  /// Hands over, in order, what is due at `stamp`: `take(stamp, told)`.
  template <class Take>
  void take(Nanoseconds stamp, Take take) {
    while (!waiting_.empty() && waiting_.front().first <= stamp) {
      const auto due = std::move(waiting_.front());
      waiting_.pop_front();
      take(due.first, due.second);
    }
  }
  /// Time went back to `now`: what was told of a later time is void.
  void forgetLater(Nanoseconds now) {
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(),
                                  [now](const auto& one) { return one.first > now; }),
                   waiting_.end());
  }
  std::size_t size() const { return waiting_.size(); }
  std::uint64_t lost() const { return lost_; }

 private:
  std::deque<std::pair<Nanoseconds, Told>> waiting_;
  std::uint64_t lost_{0};
};

}  // namespace vegetation_sim
