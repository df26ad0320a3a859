// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/grab_client.h"

#include <vegetation_sim/Grab.h>
#include <vegetation_sim/MoveGrab.h>
#include <vegetation_sim/Pick.h>
#include <vegetation_sim/Release.h>

#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim::view {
namespace {

constexpr double LEASE = 3.0;  // [s] long enough for low frame rates

// Returns false with the reason in `message`.
template <class Service>
bool ask(ros::ServiceClient& client, Service& service, std::string& message) {
  if (!client.call(service)) {
    message = "no answer from " + client.getService();
    return false;
  }
  message = service.response.message;
  return service.response.success;
}

}  // namespace

GrabClient::GrabClient(ros::NodeHandle nh, const std::string& node)
    : pick_(nh.serviceClient<Pick>(node + "/pick")),
      grab_(nh.serviceClient<vegetation_sim::Grab>(node + "/grab")),
      move_(nh.serviceClient<MoveGrab>(node + "/move_grab")),
      release_(nh.serviceClient<Release>(node + "/release")) {}

Grip GrabClient::grip() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return grip_;
}

void GrabClient::say(const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  grip_.message = message;
}

void GrabClient::take(const Ray& ray, double tolerance, const Spring& spring) {
  tasks_.add([self = shared_from_this(), ray, tolerance, spring] {
    self->releaseHeld();
    self->pickAndGrab(ray, tolerance, spring);
  });
}

void GrabClient::follow(const Vec3& target) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!grip_.holding) return;
  grip_.target = target;
  if (moving_) return;
  moving_ = true;
  tasks_.add([self = shared_from_this()] { self->move(); });
}

void GrabClient::keep() {
  const Grip now = grip();
  if (now.holding) follow(now.target);
}

void GrabClient::release() {
  tasks_.add([self = shared_from_this()] { self->releaseHeld(); });
}

void GrabClient::pickAndGrab(const Ray& ray, double tolerance, const Spring& spring) {
  std::string message;
  Pick pick;
  pick.request.origin = toPoint(ray.origin);
  pick.request.direction = toVector(ray.direction);
  pick.request.tolerance = tolerance;
  if (!ask(pick_, pick, message)) return say(message);
  vegetation_sim::Grab grab;
  grab.request.tree = pick.response.tree;
  grab.request.branch = pick.response.branch;
  grab.request.along = pick.response.along;
  grab.request.target.point = pick.response.point;
  grab.request.has_stiffness = grab.request.has_damping = true;
  grab.request.has_force_limit = grab.request.has_lease = true;
  grab.request.stiffness = spring.stiffness;
  grab.request.damping = spring.damping;
  grab.request.force_limit = spring.force_limit;
  grab.request.lease = LEASE;
  if (!ask(grab_, grab, message)) return say(message);
  const std::lock_guard<std::mutex> lock(mutex_);
  grip_ = Grip();
  grip_.holding = true;
  grip_.id = grab.response.id;
  grip_.tree = grab.response.tree;
  grip_.branch = grab.response.branch;
  grip_.start = grip_.point = grip_.target = fromMsg(grab.response.point);
  grip_.message = message;
}

void GrabClient::move() {
  MoveGrab move;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    moving_ = false;
    if (!grip_.holding) return;
    move.request.id = grip_.id;
    move.request.target.point = toPoint(grip_.target);
  }
  std::string message, why;
  const bool moved = ask(move_, move, message);
  move.request.renew_only = true;  // a target out of reach must not end the grab
  const bool held = moved || ask(move_, move, why);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!held) grip_ = Grip();
  grip_.message = message;
  if (!moved) return;
  grip_.point = fromMsg(move.response.point);
  grip_.force = fromMsg(move.response.force);
}

void GrabClient::releaseHeld() {
  const Grip held = grip();
  if (!held.holding) return;
  Release release;
  release.request.id = held.id;
  std::string message;
  ask(release_, release, message);
  const std::lock_guard<std::mutex> lock(mutex_);
  grip_ = Grip();
  grip_.message = message;
}

}  // namespace vegetation_sim::view
