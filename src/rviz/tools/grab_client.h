// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/service_client.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "rviz/tools/async_tasks.h"
#include "rviz/tools/mouse.h"

namespace vegetation_sim::view {

/// The spring between the mouse and a branch; docs/grab.md.
struct Spring {
  double stiffness{2000.0};   ///< [N/m]
  double damping{40.0};       ///< [N s/m]
  double force_limit{200.0};  ///< [N]
};

/// What a hand holds, in the world frame of the forest.
struct Grip {
  bool holding{false};
  std::uint32_t id{0}, tree{0}, branch{0};
  Vec3 start{Vec3::Zero()};   ///< where it was taken [m]
  Vec3 point{Vec3::Zero()};   ///< the point held, as last told [m]
  Vec3 target{Vec3::Zero()};  ///< where it is pulled [m]
  Vec3 force{Vec3::Zero()};   ///< of the branch on the hand [N]
  std::string message;        ///< what happened last, in words
};

/// Grabs branches of a forest over the services that everyone has. Returns at once; what came of it
/// is in `grip`. Held by a shared pointer: calls that a node answers late outlive their sender.
class GrabClient : public std::enable_shared_from_this<GrabClient> {
 public:
  /// @param node that serves ~pick, ~grab, ~move_grab and ~release.
  /// @throws ros::InvalidNameException
  GrabClient(ros::NodeHandle nh, const std::string& node);

  /// Takes the branch that a ray meets first, within `tolerance` [m] of its surface.
  void take(const Ray& ray, double tolerance, const Spring& spring);
  /// Pulls what is held to a place; of several calls before an answer only the last counts.
  void follow(const Vec3& target);
  /// Keeps the lease; call it several times a second.
  void keep();
  /// Lets go; whoever drops a hand calls it before. A process that is gone lets go too, by the
  /// lease.
  void release();
  Grip grip() const;

 private:
  void pickAndGrab(const Ray& ray, double tolerance, const Spring& spring);
  void move();
  void releaseTrees();
  void say(const std::string& message);

  ros::ServiceClient pick_, grab_, move_, release_;
  mutable std::mutex mutex_;
  Grip grip_;
  bool moving_{false};  // an errand to move waits
  AsyncTasks tasks_;
};

}  // namespace vegetation_sim::view
