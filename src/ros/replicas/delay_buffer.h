// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <utility>

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// Messages that wait until a node that runs behind the clock reaches their stamps. Those that are
/// due are taken in the order of their arrival; one of a far future does not hold back the others.
/// If too many wait, or too many bytes, the one of the latest stamp is dropped and counted: those
/// that are needed before it stay, whatever is sent for later.
template <class Message>
class DelayBuffer {
 public:
  static constexpr std::size_t MOST_WAITING = 2000, MOST_BYTES = 256'000'000;

  /// @param bytes size of the message when it is sent.
  void add(Nanoseconds stamp, std::size_t bytes, Message message) {
    waiting_.push_back({stamp, bytes, std::move(message)});
    bytes_ += bytes;
    while (waiting_.size() > MOST_WAITING || bytes_ > MOST_BYTES) dropLatest();
  }
  /// Removes the messages up to `stamp`, in order, and calls `take(stamp, message)` for each.
  template <class Take>
  void take(Nanoseconds stamp, Take take) {
    const auto later = std::stable_partition(
        waiting_.begin(), waiting_.end(), [&](const Waiting& one) { return one.stamp <= stamp; });
    const std::deque<Waiting> due(std::make_move_iterator(waiting_.begin()),
                                  std::make_move_iterator(later));
    waiting_.erase(waiting_.begin(), later);
    for (const Waiting& one : due) bytes_ -= one.bytes;
    for (const Waiting& one : due) take(one.stamp, one.message);
  }
  /// Drops the messages of later stamps, because time jumped back to `now`.
  void forgetLater(Nanoseconds now) {
    const auto later = std::stable_partition(waiting_.begin(), waiting_.end(),
                                             [&](const Waiting& one) { return one.stamp <= now; });
    for (auto one = later; one != waiting_.end(); ++one) bytes_ -= one->bytes;
    waiting_.erase(later, waiting_.end());
  }
  /// Returns whether a message up to `stamp` waits.
  bool has(Nanoseconds stamp) const {
    return std::any_of(waiting_.begin(), waiting_.end(),
                       [stamp](const Waiting& one) { return one.stamp <= stamp; });
  }
  std::size_t size() const { return waiting_.size(); }
  std::uint64_t lost() const { return lost_; }

 private:
  struct Waiting {
    Nanoseconds stamp{0};
    std::size_t bytes{0};
    Message message;
  };
  // Of several of the latest stamp, the last one.
  void dropLatest() {
    const auto latest =
        std::max_element(waiting_.rbegin(), waiting_.rend(),
                         [](const Waiting& a, const Waiting& b) { return a.stamp < b.stamp; });
    bytes_ -= latest->bytes;
    waiting_.erase(std::prev(latest.base()));
    ++lost_;
  }

  std::deque<Waiting> waiting_;
  std::size_t bytes_{0};
  std::uint64_t lost_{0};
};

}  // namespace vegetation_sim
