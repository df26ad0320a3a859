// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/ForestLayout.h>
#include <vegetation_sim/ForestState.h>
#include <vegetation_sim/GrassLayout.h>
#include <vegetation_sim/GrassState.h>
#include <vegetation_sim/WindField.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros/replicas/delay_buffer.h"
#include "ros/replicas/meadow_replica.h"
#include "sensors/sensor_scene.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim {

/// Forest, meadow, people and wind as a node that only looks hears them, at the stamp that it has
/// come to: what is told of a later one waits. A refused message changes nothing.
class LandscapeReplica {
 public:
  /// Of a message that is refused.
  using Reject = std::function<void(const std::string& what, const std::string& why)>;
  /// @param frame_id that all messages must be in.
  LandscapeReplica(std::string frame_id, Reject reject);

  void listen(ros::NodeHandle handle);
  /// Time went back to `now`: what was told of a later time is void.
  void forgetLater(Nanoseconds now);
  /// Takes what was told of moments up to `stamp`, which does not fall but by forgetLater().
  void follow(Nanoseconds stamp);
  /// Brings a scene to a stamp that was followed to, within `radius` of a place. The scene looks at
  /// what is held here until the next call of either.
  void show(const Vec3& centre, double radius, Nanoseconds stamp, scan::Scene& scene);

  bool hasForest() const { return forest_.ready(); }
  bool hasGrass() const { return meadow_.ready(); }
  std::size_t people() const { return people_.size(); }
  /// Messages that wait for their stamp, and those that found no room to.
  std::size_t waiting() const;
  std::uint64_t lost() const;
  /// Why states of forest and grass are not in step; empty: they are, or there are none.
  std::string waitsFor() const;

  /// For so long a walker is seen that nothing is told of [s].
  static constexpr double LONGEST_SILENCE = 3.0;
  /// For so long it goes on as it went [s].
  static constexpr double LONGEST_GUESS = 0.25;

 private:
  void onWind(const WindField& message);
  void onForestLayout(const ForestLayout& message);
  void onForestState(const ForestState& message);
  void onGrassLayout(const GrassLayout& message);
  void onGrassState(const GrassState& message);
  void onPeople(const AgentStates& message);
  /// Runs `take`; what it throws is a refusal.
  void guard(const char* what, const std::function<void()>& take);
  std::shared_ptr<const terrain::HeightMap> ground() const;
  std::vector<scan::People::Person> peopleAt(Nanoseconds stamp) const;

  std::string frame_id_;
  Reject reject_;
  wind::Field wind_;
  forest::ForestReplica forest_;
  std::shared_ptr<const terrain::HeightMap> forest_ground_;
  MeadowReplica meadow_;
  DelayBuffer<forest::StateUpdate> forest_ahead_;
  DelayBuffer<grass::TreadUpdate> treads_ahead_;
  DelayBuffer<std::vector<crowd::Walker>> people_ahead_;
  std::vector<crowd::Walker> people_;  // at people_stamp_
  Nanoseconds people_stamp_{0};
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace vegetation_sim
