// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/AgentStates.h>

#include <vector>

#include "crowd/body/walker.h"
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
  ~SubscribedCrowd() override { subscribers_.clear(); }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const std::string& topic);
  void apply(const AgentStates& message) override;
  bool accepts(const AgentStates& message) override;
  /// Time jumped back to `now`: people of a later stamp are removed.
  void forgetLater(Nanoseconds now);
  /// Removes all people if the newest message is older than SILENCE.
  void forgetSilent(Nanoseconds now);
  /// Removes all people if nothing has changed for longer than SILENCE in the time of the calls.
  /// Stamps have no effect: the clock of the picture may differ from them.
  void forgetUnchanged(Nanoseconds now);

  /// Whether a publisher of the topic is connected.
  bool isPublished() const;
  const std::vector<Person>& people() const { return people_; }
  Nanoseconds stamp() const { return stamp_; }
  /// Number of changes; 0: no message has been accepted.
  int changes() const { return changes_; }
  const InputStatus& status() const { return status_; }

 private:
  void clear(const char* why);

  std::vector<Person> people_;
  Nanoseconds stamp_{0};
  int changes_{0}, seen_changes_{0};
  Nanoseconds changed_{0};  // time of the call of forgetUnchanged() after the last change
  InputStatus status_;
};

}  // namespace vegetation_sim
