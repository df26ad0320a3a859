// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <tf2_ros/buffer.h>
#include <vegetation_sim/ApplyForce.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Release.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "forest/tree_cache.h"
#include "nodes/forest/forest_inputs.h"
#include "nodes/forest/forest_options.h"

namespace vegetation_sim {

/// What a desk needs of its node.
struct GrabDependencies {
  const ForestOptions& options;
  const forest::Forest& forest;
  forest::TreeCache& cache;
  ForestInputs& inputs;
  const tf2_ros::Buffer& tf;
};

/// Takes requests to grab, move, release and push, checks them and makes them events of the next
/// tick; moves the grabs that follow a tf frame; tells the wrenches on those who hold.
class GrabManager {
 public:
  explicit GrabManager(GrabDependencies room) : room_(room) {}

  // Bodies of the services; what they return is their message. All throw InvalidInput, and then
  // nothing has changed.
  std::string grab(const Grab::Request& request, Grab::Response& response);
  std::string move(const MoveGrab::Request& request, MoveGrab::Response& response);
  std::string release(const Release::Request& request);
  std::string push(const ApplyForce::Request& request, ApplyForce::Response& response);

  /// Before the tick `stamp`: moves every grab whose frame tf has told anew since the last call.
  /// Told of what keeps a frame from being followed: its name and why.
  using Report = std::function<void(const std::string&, const std::string&)>;
  void follow(Nanoseconds stamp, const Report& report);
  /// Before the forest takes an event: a grab that is tied to a frame begins where that is by now.
  /// @throws InvalidInput if tf does not tell it any more, or it is too far away.
  void aim(ForestEvent& event);
  /// An event that the forest has taken.
  void applyDelta(const ForestEvent& event);
  /// One that it refused: a grab that waited for it is over.
  void drop(const ForestEvent& event);
  /// After a tick: forgets grabs that are over. @return those that ended by themselves.
  std::vector<forest::Grab> settle();
  /// All that is in force, or what only waits too.
  void clear(bool waiting_too);

  /// On every body that holds or touches a branch, at the last tick, in its frame. Held by nobody's
  /// frame: world axes, about the point held.
  std::vector<geometry_msgs::WrenchStamped> wrenches() const;
  /// Grabs of a tree, those in force.
  std::vector<BranchGrab> grabsOf(std::uint32_t tree) const;
  /// Branches that are held.
  std::vector<forest::BranchPoint> heldPoints() const;
  /// Grabs whose frame was not told anew at the last tick.
  std::size_t silent() const { return silent_; }

 private:
  struct Held {
    BranchGrab grab;
    bool in_force{false};
    bool keep_offset{false};
    ros::Time begins;     ///< zero: at the next tick
    ros::Time published;  ///< newest transform used
  };
  struct Place {
    forest::BranchPoint at;
    Vec3 point;  // world
  };
  std::shared_ptr<const forest::Tree> grown(std::uint32_t tree) const;
  Place placeOf(std::uint32_t tree, std::uint32_t branch, double along) const;
  Place nearestTo(const geometry_msgs::PointStamped& point) const;
  template <class Request>
  Place choose(const Request& request) const;
  Vec3 inWorld(const geometry_msgs::PointStamped& point, const char* name) const;
  void tie(const Vec3& point, Held& out) const;
  double checkTarget(const BranchGrab& grab, const Vec3& point) const;
  void checkRoom(const char* what, const Place& place, const ros::Time& stamp) const;
  static bool waitsLonger(const Held& held, const ros::Time& stamp);
  bool followOne(Held& held, Nanoseconds stamp);
  Held& find(std::uint32_t id);
  std::map<std::uint32_t, Held>::iterator forget(std::map<std::uint32_t, Held>::iterator entry);
  ForestEvent eventAt(std::uint8_t kind, const ros::Time& stamp) const;
  void enqueue(const ForestEvent& event);
  void requireLive() const;
  Pose frameOf(const forest::Reaction& reaction) const;

  GrabDependencies room_;
  std::map<std::uint32_t, Held> held_;        // waiting ones among them
  std::map<std::uint32_t, Pose> gone_;        // holders of grabs that are over, still told
  std::map<std::string, ForestBody> bodies_;  // by id, as last told
  std::uint32_t last_id_{0};
  std::size_t silent_{0};
};

}  // namespace vegetation_sim
