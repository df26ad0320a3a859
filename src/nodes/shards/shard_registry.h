// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/ShardNode.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/config/shard.h"

namespace vegetation_sim {

/// Knows the node of each other shard by what it announces. All functions may be called from any
/// thread.
class ShardRegistry {
 public:
  struct Peer {
    std::string node;
    std::atomic<int> overdue{0};  ///< requests that wait for it beyond their time limit
  };

  /// @param node name of the node of `shard` itself.
  ShardRegistry(const Shard& shard, std::string node) : shard_(shard), node_(std::move(node)) {}

  const Shard& shard() const { return shard_; }
  const std::string& node() const { return node_; }
  /// Takes an announcement; the latest one of a shard counts.
  /// @throws InvalidInput that names the node if it has another number of shards or this shard.
  void hear(const ShardNode& message);
  /// @throws InvalidInput that names the shard if no node has announced it.
  std::shared_ptr<Peer> find(std::uint32_t shard) const;
  /// Lists the other shards that no node has announced: "1, 3".
  std::string describeMissing() const;

 private:
  const Shard shard_;
  const std::string node_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::shared_ptr<Peer>> peers_;
};

/// Returns "shard 1 of 4".
std::string describeShard(std::uint32_t shard, std::uint32_t count);

}  // namespace vegetation_sim
