// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <vegetation_sim/CrowdBorder.h>

#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include "core/config/shard.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim {

/// The borders of the other shards of a crowd as they were after the tick before. A tick waits for
/// those of all shards. One that does not come in time is not awaited again until it sends.
class BorderInbox {
 public:
  /// @param wait wall time for which a tick waits [s].
  BorderInbox(ros::NodeHandle handle, const Shard& shard, double wait);

  /// Returns the newest border of each shard that is earlier than the tick `now`, by rising shard.
  /// @param before stamp of the tick before, for whose borders it waits; 0: any.
  std::vector<CrowdBorder> take(Nanoseconds before, Nanoseconds now);
  /// Forgets all borders, after a jump of time.
  void clear();
  /// Number of borders that have not come in time.
  std::size_t late() const { return late_; }

 private:
  void onBorder(const CrowdBorder& message);
  bool hasAll(Nanoseconds before) const;

  Shard shard_;
  double wait_;
  // Callbacks run during a tick. It is declared before the subscriber, which ends first.
  ros::CallbackQueue queue_;
  std::map<std::uint32_t, std::vector<CrowdBorder>> waiting_;  // by shard, by rising stamp
  std::map<std::uint32_t, Nanoseconds> newest_;                // stamps by shard
  std::set<std::uint32_t> awaited_;                            // shards
  std::size_t late_{0};
  ros::Subscriber subscriber_;
};

}  // namespace vegetation_sim
