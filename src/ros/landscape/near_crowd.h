// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vegetation_sim/NearAgents.h>

#include <string>
#include <vector>

#include "core/lod/interest_regions.h"
#include "ros/replicas/subscribed_crowd.h"

namespace vegetation_sim {

/// The people near sensors, of another node.
class NearCrowd final : public SubscribedReplica<NearAgents> {
 public:
  explicit NearCrowd(const ReplicaOptions& options) : SubscribedReplica(options) {}
  ~NearCrowd() override { subscribers_.clear(); }

  /// @throws ros::InvalidNameException
  void subscribe(ros::NodeHandle handle, const std::string& topic);
  void apply(const NearAgents& message) override;
  bool accepts(const NearAgents& message) override;
  /// Time jumped back to `now`: people of a later stamp are removed.
  void forgetLater(Nanoseconds now);
  /// Removes all people if the newest message is older than SILENCE.
  void forgetSilent(Nanoseconds now);

  /// Returns whether the last message has all people within `radius` [m] of a place who can be met
  /// there at `stamp`.
  bool covers(const Vec3& centre, double radius, Nanoseconds stamp) const;
  const std::vector<WalkerView>& people() const { return people_; }
  /// Stamp of the last message; 0: there was none.
  Nanoseconds stamp() const { return stamp_; }

 private:
  void clear();

  std::vector<WalkerView> people_;
  std::vector<InterestArea> discs_;
  Nanoseconds stamp_{0};
  InputStatus status_;
};

}  // namespace vegetation_sim
