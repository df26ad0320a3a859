// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ShardNode.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "core/shards/shard_split.h"

namespace vegetation_sim {

/// Knows the node of each other shard by what it announces. All functions may be called from any
/// thread.
class ShardRegistry {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  struct Peer {
    std::string node;
    ros::Time started;
    std::atomic<int> overdue{0};  ///< requests that wait for it beyond their time limit
  };

  /// @param own announcement of the node of this shard.
  explicit ShardRegistry(ShardNode own) : own_(std::move(own)) {}

  Shard shard() const { return {own_.shard, own_.shards}; }
  const std::string& node() const { return own_.node; }
  const ShardNode& own() const { return own_; }
  /// Takes an announcement; the latest one of a shard counts.
  /// @throws InvalidInput that names the node if it does not fit: it has no valid name, this shard,
  /// another number of shards, or another layout, terrain, rate or version of messages.
  /// @param process name of the ROS node that has sent it, in which the nodelet may run.
  void hear(const ShardNode& message, const std::string& process, SteadyTime now);
  /// @throws InvalidInput that names both processes, unless the sender of a message of a shard is
  /// the one that has announced the shard, or none has.
  void checkSender(std::uint32_t shard, const std::string& process) const;
  /// @throws InvalidInput as hear() does.
  void checkFit(const ShardNode& message) const;
  /// Returns whether the node of another shard answers requests.
  bool isOpen(std::uint32_t shard) const;
  /// Returns whether the node of an announcement was there before this one, which starts: its
  /// services are open, or its start is earlier. Clocks of hosts may differ.
  bool isEarlier(const ShardNode& message) const;
  /// @throws InvalidInput that names the shard if no node has announced it.
  std::shared_ptr<Peer> find(std::uint32_t shard) const;
  /// Lists the other shards that no node has announced: "1, 3".
  std::string describeMissing() const;
  /// Lists the shards that have announced themselves, but not in the last 3 s: "1 (/forest_1)".
  std::string describeSilent(SteadyTime now) const;

 private:
  const ShardNode own_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::shared_ptr<Peer>> peers_;
  std::map<std::uint32_t, SteadyTime> heard_;
  std::map<std::uint32_t, std::string> processes_;
};

/// Returns "shard 1 of 4".
std::string describeShard(std::uint32_t shard, std::uint32_t count);

}  // namespace vegetation_sim
