// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <tf2_ros/buffer.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/archive.h"
#include "nodes/grass/grass_options.h"
#include "ros/services/frame_lookup.h"
#include "ros/services/missing_inputs.h"

namespace vegetation_sim {

/// Sources of treading that the node finds by itself (N4): tf frames and odometry. The node asks at
/// each tick; a replay needs no tf, since the treads are events.
class GrassSources {
 public:
  /// A source without a position for this long has left the ground [s].
  static constexpr double STALE = 0.5;
  /// Period at which a source at rest is repeated [s].
  static constexpr double REMINDER = 1.0;

  /// `buffer` must outlive it. @param wait for the transforms of a tick [s], see FrameLookup.
  GrassSources(ros::NodeHandle handle, std::string frame_id, std::vector<FollowedSource> sources,
               const tf2_ros::Buffer& buffer, double wait);

  /// Where a source is.
  struct ObservedSource {
    Nanoseconds stamp{0};
    Vec3 position{Vec3::Zero()};
    std::optional<Vec3> velocity;
  };
  /// Returns where odometry has a point of the body, world. @param offset of the point in the frame
  /// of the body. @throws InvalidInput for an invalid orientation.
  static ObservedSource observe(const nav_msgs::Odometry& message, const Pose& to_world,
                                const Vec3& offset, Nanoseconds now);

  /// Returns the treads of each source since the last call: it moved, left, or is repeated at rest.
  /// Positions are in the world frame; `own` and `height_gate` are for sources without values of
  /// their own. Calls `report` with the name and the fault of each source whose odometry is
  /// invalid.
  using Report = std::function<void(const std::string&, const std::string&)>;
  std::vector<grass::TreadInput> update(Nanoseconds now, const grass::TreadLaw& own,
                                        double height_gate, const Report& report);
  /// Where a source was when a tread was last made of it.
  struct LastTread {
    Vec3 position{Vec3::Zero()};
    Nanoseconds stamp{0};
  };
  /// Maps the names of the sources on the ground to their last treads.
  using Published = std::map<std::string, LastTread>;
  Published published() const;
  /// Continues from these; others are not on the ground.
  void restore(const Published& published);
  static void archive(Archive& a, Published& published);

  /// Transforms and odometry that the last update missed.
  MissingInputs& missing() { return missing_; }
  /// Number of transforms that have not come in time for their tick.
  std::size_t late() const { return lookup_.late(); }
  /// Forgets all positions, after a jump of time.
  void clear();

 private:
  struct Followed {
    FollowedSource source;
    std::optional<nav_msgs::Odometry> odometry;
    std::optional<Vec3> published;  ///< position
    Nanoseconds published_stamp{0};
    std::string fault{};  ///< of odometry since the last tick, also if other odometry followed it
  };
  ObservedSource find(const Followed& followed, Nanoseconds now);
  ObservedSource findOdometry(const Followed& followed, Nanoseconds now);
  std::string describeMissing(const Followed& followed) const;
  void say(const Followed& followed, grass::TreadAction action, const ObservedSource& heard,
           std::vector<grass::TreadInput>& out) const;

  std::string frame_id_;
  std::vector<Followed> followed_;
  const tf2_ros::Buffer& buffer_;
  FrameLookup lookup_;
  std::vector<ros::Subscriber> subscribers_;
  MissingInputs missing_;
  grass::TreadLaw own_;
  double height_gate_{0.3};
};

}  // namespace vegetation_sim
