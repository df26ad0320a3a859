// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros/landscape/near_choice.h"
#include "ros/landscape/near_crowd.h"
#include "ros/replicas/subscribed_canopy.h"
#include "ros/replicas/subscribed_crowd.h"
#include "ros/replicas/subscribed_forest.h"
#include "ros/replicas/subscribed_meadow.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim {

/// Forest, meadow, leafy plants, people and wind at one stamp, for a node that runs behind the
/// clock: states with later stamps wait.
class LandscapeReplica {
 public:
  /// @param options are made delayed.
  explicit LandscapeReplica(ReplicaOptions options);

  void subscribe(ros::NodeHandle handle);
  /// Time jumped back to `now`: later states are dropped.
  void forgetLater(Nanoseconds now);
  /// Applies the states up to `stamp`, which rises except by forgetLater().
  void advance(Nanoseconds stamp);
  /// Brings a scene within `radius` of a place to the stamp of the last advance(). The scene refers
  /// to the replicas until the next call of a function that is not const.
  void update(const Vec3& centre, double radius, Nanoseconds stamp, scan::Scene& scene,
              ThreadPool& threads);

  /// Number of calls of update() that lacked people or tracks in the radius. All are received after
  /// such a call.
  std::uint64_t incomplete() const { return incomplete_; }
  std::size_t people() const { return nearest().size(); }
  /// Number of states that wait for their stamp, and of those that were dropped.
  std::size_t waiting() const;
  std::uint64_t lost() const;
  /// Why states of forest and grass are ignored; empty if they are not, or if there are none.
  std::string why() const;
  /// Why the only layout of forest, grass or plants that has come was rejected; empty if none was.
  std::string rejectedLayout() const;
  /// Topics that have several publishers; empty if there are none.
  std::string rivals() const;

 private:
  std::shared_ptr<const terrain::HeightMap> ground() const;
  std::vector<scan::CrownSource> crownsOf(const scan::Trees& trees, Nanoseconds stamp) const;
  const SubscribedMeadow& tracks() const { return readsNearMeadow() ? near_meadow_ : meadow_; }
  bool readsNearMeadow() const { return tracks_.isNear() && near_meadow_.ready(); }
  void chooseTracks(const Vec3& centre, double radius, Nanoseconds stamp);
  void choosePeople(const Vec3& centre, double radius, Nanoseconds stamp);
  const std::vector<WalkerView>& nearest() const {
    return people_.isNear() ? near_crowd_.people() : crowd_.people();
  }
  std::vector<scan::People::Person> peopleAt(Nanoseconds stamp) const;

  SubscribedForest forest_;
  SubscribedMeadow meadow_, near_meadow_;
  SubscribedCanopy canopy_;
  SubscribedCrowd crowd_;
  NearCrowd near_crowd_;
  NearChoice people_, tracks_;
  std::uint64_t incomplete_{0};
};

}  // namespace vegetation_sim
