// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/buffer.h>
#include <vegetation_sim/ApplyForce.h>
#include <vegetation_sim/ContactForces.h>
#include <vegetation_sim/CutBranch.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Release.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/archive/archive.h"
#include "forest/nearest.h"
#include "forest/tree_cache.h"
#include "nodes/forest/forest_inputs.h"
#include "nodes/forest/forest_options.h"
#include "nodes/forest/grab_history.h"
#include "ros/services/frame_lookup.h"

namespace vegetation_sim {

/// Parts of the node that GrabManager uses.
struct GrabDependencies {
  const ForestOptions& options;
  const forest::Forest& forest;
  forest::TreeCache& cache;
  ForestInputs& inputs;
  const tf2_ros::Buffer& tf;
  /// Called after changes that are in the state of GrabManager and in no event.
  std::function<void()> on_change = [] {};
};

/// Returns the pose of a grab's holder; tf takes orientations whose norm is not quite 1.
Pose holderPose(const geometry_msgs::TransformStamped& transform);

/// Checks requests to grab, move, release, push and cut, and queues them as events; moves the grabs
/// that follow a tf frame; reports the wrenches on the bodies that hold or touch branches. A grab
/// itself is an event until its tick and then an entry of Forest::grabs().
class GrabManager {
 public:
  explicit GrabManager(GrabDependencies node)
      : node_(node), lookup_(node.tf, node.options.frame_id, node.options.frame_wait) {}

  // Bodies of the services; each returns its message. All throw InvalidInput, and then nothing has
  // changed.
  std::string grab(const Grab::Request& request, Grab::Response& response);
  std::string move(const MoveGrab::Request& request, MoveGrab::Response& response);
  std::string release(const Release::Request& request);
  std::string push(const ApplyForce::Request& request, ApplyForce::Response& response);
  std::string cut(const CutBranch::Request& request, CutBranch::Response& response);

  /// Returns the branch of this shard that is nearest to a point. @throws InvalidInput
  forest::Nearest findNearest(const geometry_msgs::PointStamped& point) const;
  /// Lists in rising order the shards that own trees which may have a branch near a point.
  /// @throws InvalidInput
  std::vector<std::uint32_t> listOwnersNear(const geometry_msgs::PointStamped& point) const;

  /// Before the tick `stamp`: moves every grab whose frame has a new transform since the last call.
  /// Calls `report` with the name and the fault of each frame that cannot be followed.
  using Report = std::function<void(const std::string&, const std::string&)>;
  void follow(Nanoseconds stamp, const Report& report);
  /// Before the forest applies an event: a grab with a frame begins where that is now, and a jaw
  /// keeps the direction that the branch has now.
  /// @throws InvalidInput if tf has no recent transform, or it is too far away.
  void followFrame(ForestInput& event);
  /// Says why a grab, or all grabs, will not be in force after this tick: GrabStatus::RELEASED and
  /// so on.
  void explainEnd(std::uint32_t id, std::uint8_t reason) { history_.explain(id, reason); }
  void explainEnds(std::uint8_t reason) { history_.explainAll(reason); }
  /// After a tick: forgets grabs that are over. @return whether any has begun or ended.
  bool update();
  /// Forgets all grabs, after a jump of the clock back.
  void clear();

  /// Data of a requested grab besides the grab itself.
  struct Request {
    bool keep_offset{false};
    Nanoseconds begins{0};  ///< 0: at the next tick
    ros::Time published;    ///< newest transform of its frame that was used
    bool begun{false};      ///< it was in force at an update
  };
  /// The part of the saved state of the node that this class keeps.
  struct State {
    std::map<std::uint32_t, Request> requests;
    GrabHistory::State history;
    std::uint32_t last_id{0};
  };
  State state() const { return {requests_, history_.state(), last_id_}; }
  /// To be called after the forest is restored.
  void restore(const State& state);
  static void archive(Archive& a, State& state);
  /// Knows a grab that waits after a restart of the node, so that its holder can move it and its id
  /// is not used again.
  void addRequest(const ForestInput& event);

  /// Forces at the last tick on everything that holds or touches a branch.
  ContactForces forces() const;
  /// Grabs at the last tick.
  GrabStatuses statuses() const;
  /// Grabs in force of a tree.
  std::vector<BranchGrab> grabsOf(std::uint32_t tree) const;
  /// Points of the grabs in force.
  std::vector<forest::BranchPoint> heldPoints() const;
  /// Number of grabs whose frame had no new transform at the last tick.
  std::size_t silent() const { return silent_; }
  /// Number of transforms that have not come in time, see FrameLookup.
  std::size_t late() const { return lookup_.late(); }

 private:
  struct Place {
    forest::BranchPoint at;
    Vec3 point;  // world
    Vec3 axis;   // along the branch, world
  };
  std::shared_ptr<const forest::Tree> grown(std::uint32_t tree) const;
  Place placeOf(std::uint32_t tree, std::uint32_t branch, double along) const;
  Vec3 pointOf(const forest::Grab& grab) const;
  std::optional<forest::Nearest> searchNear(
      const geometry_msgs::PointStamped& point,
      const std::function<bool(std::uint32_t tree)>& is_searched) const;
  template <class ServiceRequest>
  Place choose(const ServiceRequest& request) const;
  Vec3 inWorld(const geometry_msgs::PointStamped& point, const char* name) const;
  void setByFrame(const Vec3& point, const geometry_msgs::TransformStamped& newest,
                  forest::Grab& grab, Request& request) const;
  geometry_msgs::TransformStamped awaitFrame(const std::string& frame);
  void setDirection(forest::Grab& grab) const;
  double checkTarget(const forest::Grab& grab, const Vec3& point) const;
  void checkRoom(const char* what, const Place& place, const ros::Time& stamp) const;
  bool isInForce(std::uint32_t id) const { return node_.forest.grabs().count(id) > 0; }
  bool followOne(const forest::Grab& grab, Request& request, Nanoseconds stamp);
  Request& find(std::uint32_t id);
  const forest::Grab& grabOf(std::uint32_t id) const;
  ForestInput eventAt(ForestInput::Kind kind, const ros::Time& stamp) const;
  void enqueue(const ForestInput& event);
  void enqueueGrab(const ForestInput& event, const Request& request);
  void requireLive() const;
  Pose frameOf(const forest::Reaction& reaction) const;

  GrabDependencies node_;
  FrameLookup lookup_;
  std::map<std::uint32_t, Request> requests_;  // by id, of grabs that wait or are in force
  GrabHistory history_;
  std::uint32_t last_id_{0};
  std::size_t silent_{0};
};

}  // namespace vegetation_sim
