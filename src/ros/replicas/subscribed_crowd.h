// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/AgentStates.h>

#include <vector>

#include "crowd/walker/walker.h"
#include "ros/replicas/subscribed_replica.h"

namespace vegetation_sim {

/// The people of another node.
class SubscribedCrowd : public SubscribedReplica<AgentStates> {
 public:
  struct Person {
    crowd::Walker walker;
    double ground{0.0};  ///< height at which the person stands [m]
  };

  explicit SubscribedCrowd(const ReplicaOptions& options = {}) : SubscribedReplica(options) {}

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const std::string& topic);
  void apply(const AgentStates& message) override;
  /// Time jumped back to `now`: people of a later stamp are removed.
  void forgetLater(Nanoseconds now);
  /// Removes all people if the newest message is older than SILENCE.
  void forgetSilent(Nanoseconds now);

  const std::vector<Person>& people() const { return people_; }
  Nanoseconds stamp() const { return stamp_; }
  /// Number of changes; 0: no message has been accepted.
  int changes() const { return changes_; }
  const InputStatus& status() const { return status_; }

 private:
  void clear(const char* why);

  std::vector<Person> people_;
  Nanoseconds stamp_{0};
  int changes_{0};
  InputStatus status_;
};

}  // namespace vegetation_sim
