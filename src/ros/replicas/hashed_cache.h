// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>

namespace vegetation_sim {

/// The newest messages of a topic by their hashes, to which events refer.
template <class Message>
class HashedCache {
 public:
  explicit HashedCache(std::size_t most = 8) : most_(most) {}

  /// Adds a message, and drops the oldest if there are more than `most`.
  void keep(std::uint64_t hash, const Message& message) {
    all_.erase(std::remove_if(all_.begin(), all_.end(),
                              [&](const auto& one) { return one.first == hash; }),
               all_.end());
    all_.emplace_back(hash, message);
    if (all_.size() > most_) all_.pop_front();
  }
  /// Returns null if there is no message with this hash.
  const Message* find(std::uint64_t hash) const {
    for (const auto& one : all_)
      if (one.first == hash) return &one.second;
    return nullptr;
  }

 private:
  std::size_t most_;
  std::deque<std::pair<std::uint64_t, Message>> all_;  ///< oldest first
};

}  // namespace vegetation_sim
