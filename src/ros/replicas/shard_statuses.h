// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "ros/replicas/input_status.h"

namespace vegetation_sim {

/// The statuses of the states of the shards of a landscape.
class ShardStatuses {
 public:
  void clear() { statuses_.clear(); }
  /// Keeps the status of the last message of a shard.
  void set(std::uint32_t shard, const InputStatus& status) { statuses_[shard] = status; }
  /// Returns the status of one shard. @param stamp of its last message that was applied.
  InputStatus of(std::uint32_t shard, Nanoseconds stamp, Nanoseconds now) const {
    const auto found = statuses_.find(shard);
    if (found == statuses_.end()) return {false, "No state: its plants are at rest"};
    return unlessSilent(found->second, stamp, now);
  }
  /// Returns the status of all shards. It names those that are not in use.
  /// @param status_of returns that of one.
  template <class StatusOf>
  static InputStatus all(std::uint32_t shards, const StatusOf& status_of) {
    InputStatus out{true, "In step: " + std::to_string(shards) + " shards"};
    for (std::uint32_t shard = 0; shard < shards; ++shard) {
      const InputStatus one = status_of(shard);
      if (one.good) continue;
      const std::string text = "Shard " + std::to_string(shard) + ": " + one.text;
      out = {false, out.good ? text : out.text + "; " + text};
    }
    return out;
  }

 private:
  std::map<std::uint32_t, InputStatus> statuses_;  // of the shards that have been heard
};

}  // namespace vegetation_sim
