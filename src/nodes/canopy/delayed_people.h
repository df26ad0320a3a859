// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <string>

#include "ros/replicas/subscribed_crowd.h"

namespace vegetation_sim {

/// The people of another node as they were at the tick before, so that a tick never depends on
/// whether their message of the same tick has come. With a wait a tick does not depend on when the
/// message before has come either.
class DelayedPeople {
 public:
  /// @param wait wall time for which a tick waits for people [s].
  DelayedPeople(ReplicaOptions options, double wait);

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const std::string& topic);
  /// Takes the people up to `before`, the stamp of the tick before. A wait lasts while people are
  /// due: their period is the least one seen between two messages.
  void advance(Nanoseconds before);
  /// Removes all people, because the clock has jumped back to `now`.
  void forgetLater(Nanoseconds now);

  const SubscribedCrowd& crowd() const { return crowd_; }
  /// Number of ticks whose people have not come in time.
  std::size_t late() const { return late_; }

 private:
  bool isDue(Nanoseconds before) const;
  void take(Nanoseconds before);

  double wait_;
  // Callbacks run during a tick. It is declared before the subscriber, which ends first.
  ros::CallbackQueue queue_;
  SubscribedCrowd crowd_;
  Nanoseconds period_{0};  // of the messages; 0: unknown
  std::size_t late_{0};
};

}  // namespace vegetation_sim
