// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue_interface.h>

#include <cstdint>
#include <memory>

namespace vegetation_sim {

/// Passes the callbacks of a node on to another queue until it is closed; then none runs any more.
/// To destroy a roscpp object is not enough for that, since dynamic_reconfigure::Server ends its
/// service last, and a callback of it that runs in another thread uses what is destroyed already.
class ClosableQueue final : public ros::CallbackQueueInterface {
 public:
  /// @param target must exist until close().
  explicit ClosableQueue(ros::CallbackQueueInterface& target);

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
  void removeByID(std::uint64_t owner) override;
  /// Waits for the callbacks that run. Callbacks that wait and those that are added later are
  /// dropped. No callback of this queue may call it.
  void close();

 private:
  struct Gate;
  class Visit;
  class Guarded;

  ros::CallbackQueueInterface& target_;
  std::shared_ptr<Gate> gate_;
};

/// Returns a new queue that is never destroyed, as threads of roscpp may still refer to the queue
/// of a node that has ended.
ClosableQueue& makeClosableQueue(ros::CallbackQueueInterface& target);

}  // namespace vegetation_sim
