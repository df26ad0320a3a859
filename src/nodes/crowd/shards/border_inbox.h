// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "nodes/crowd/shards/waiting_borders.h"

namespace vegetation_sim {

/// The borders of the other shards of a crowd as they were after the tick before. A tick waits for
/// those of all shards. One that does not come in time is not awaited again until it sends.
class BorderInbox {
 public:
  /// @param wait wall time for which a tick waits [s]; the first waits longer. @param
  /// is_from_shard whether a process sends the messages of a shard; others are ignored.
  BorderInbox(ros::NodeHandle handle, const Shard& shard, double wait,
              std::function<bool(std::uint32_t shard, const std::string& process)> is_from_shard);

  /// Returns the newest border of each shard that is earlier than the tick `now`, by rising shard.
  /// @param before stamp of the tick before, for whose borders it waits; 0: any.
  std::vector<CrowdBorder> take(Nanoseconds before, Nanoseconds now);
  /// Whether a shard has sent the border after a later tick: it has run before this one.
  bool isAnyAhead() const { return borders_.isAnyAhead(); }
  /// Whether a border of a shard has come.
  bool hasSent(std::uint32_t shard) const { return borders_.hasSent(shard); }
  /// Forgets the borders from before a jump back of the clock.
  void jumpBack() { borders_.jumpBack(); }
  /// Number of borders that have not come in time.
  std::size_t late() const { return late_; }
  /// Number of borders that were dropped because too large ones wait.
  std::uint64_t dropped() const { return borders_.dropped(); }

 private:
  double wait_;
  WaitingBorders borders_;
  std::size_t late_{0};
  // Callbacks run during a tick. It is declared before the subscriber, which ends first.
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
};

}  // namespace vegetation_sim
