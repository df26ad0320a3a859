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

/// The spring between the mouse and a branch, see docs/grab.md.
struct Spring {
  double stiffness{2000.0};   ///< [N/m]
  double damping{40.0};       ///< [N s/m]
  double force_limit{200.0};  ///< [N]
};

/// State of the held branch, in the world frame of the forest.
struct Grip {
  bool holding{false};
  std::uint32_t id{0}, tree{0}, branch{0};
  Vec3 start{Vec3::Zero()};   ///< where it was grabbed [m]
  Vec3 point{Vec3::Zero()};   ///< last known place of the held point [m]
  Vec3 target{Vec3::Zero()};  ///< target of the spring [m]
  Vec3 force{Vec3::Zero()};   ///< of the branch on the mouse [N]
  std::string message;        ///< last result for the user
};

/// Grabs branches of a forest by its public services. Functions return at once; results are in
/// grip(). It is held by a shared pointer, since late replies outlive their sender.
class GrabClient : public std::enable_shared_from_this<GrabClient> {
 public:
  /// @param node node with the services ~pick, ~grab, ~move_grab and ~release.
  /// @throws ros::InvalidNameException
  GrabClient(ros::NodeHandle nh, const std::string& node);

  /// Grabs the branch that a ray meets first, within `tolerance` [m] of its surface.
  void take(const Ray& ray, double tolerance, const Spring& spring);
  /// Moves the target; of several calls before a reply only the last one is sent.
  void follow(const Vec3& target);
  /// Renews the lease; call it several times a second.
  void keep();
  /// Releases the branch; call it before the client is dropped. The lease releases it if the
  /// process ends.
  void release();
  Grip grip() const;

 private:
  void pickAndGrab(const Ray& ray, double tolerance, const Spring& spring);
  void move();
  void releaseHeld();
  void say(const std::string& message);

  ros::ServiceClient pick_, grab_, move_, release_;
  mutable std::mutex mutex_;
  Grip grip_;
  bool moving_{false};  // a move request is queued
  AsyncTasks tasks_;
};

}  // namespace vegetation_sim::view
