// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <tf2/exceptions.h>

#include "forest/contact/contact_body.h"
#include "nodes/forest/grab_manager.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {

// The transform of the tick itself where tf has it, else the newest one.
bool GrabManager::followOne(Held& held, Nanoseconds stamp) {
  const std::string &world = room_.options.frame_id, &frame = held.grab.frame;
  geometry_msgs::TransformStamped newest = room_.tf.lookupTransform(world, frame, ros::Time(0));
  const ros::Time published = newest.header.stamp;
  if (!published.isZero() && published <= held.published) return false;
  const ros::Time tick = toStamp(stamp);
  if (published > tick && room_.tf.canTransform(world, frame, tick))
    newest = room_.tf.lookupTransform(world, frame, tick);
  ForestEvent event;
  event.kind = ForestEvent::MOVE;
  event.grab.id = held.grab.id;
  const Pose pose = fromMsg(newest.transform);
  event.grab.holder = toMsg(pose);
  event.grab.target = toPoint(transformed(pose, fromMsg(held.grab.offset)));
  BranchGrab moved = held.grab;
  moved.target = event.grab.target;
  checkTarget(moved, placeOf(moved.tree, moved.branch, moved.along).point);
  held.published = published;
  room_.inputs.addFirst(event);
  return true;
}

void GrabManager::follow(Nanoseconds stamp, const Report& report) {
  silent_ = 0;
  if (room_.options.replay) return;
  for (auto& [id, held] : held_) {
    if (held.grab.frame.empty() || !held.in_force) continue;
    try {
      silent_ += followOne(held, stamp) ? 0 : 1;
    } catch (const tf2::TransformException&) {
      ++silent_;  // it waits where it is until its lease ends
    } catch (const InvalidInput& error) {
      ++silent_;
      report("frame of grab " + std::to_string(id), error.what());
    }
  }
}

void GrabManager::aim(ForestEvent& event) {
  if (event.kind != ForestEvent::GRAB || event.grab.frame.empty() || room_.options.replay) return;
  const auto found = held_.find(event.grab.id);
  if (found == held_.end()) return;
  const Vec3 point = placeOf(event.grab.tree, event.grab.branch, event.grab.along).point;
  tie(point, found->second);
  checkTarget(found->second.grab, point);
  event.grab = found->second.grab;
}

void GrabManager::applyDelta(const ForestEvent& event) {
  switch (event.kind) {
    case ForestEvent::GRAB: {
      Held& held = held_[event.grab.id];
      held.grab = event.grab;
      held.in_force = true;
      break;
    }
    case ForestEvent::MOVE: {
      const auto found = held_.find(event.grab.id);
      if (found == held_.end()) break;
      found->second.grab.target = event.grab.target;
      found->second.grab.holder = event.grab.holder;
      break;
    }
    case ForestEvent::RELEASE: {
      const auto found = held_.find(event.grab.id);
      if (found != held_.end()) forget(found);
      break;
    }
    case ForestEvent::BODY:
      bodies_[event.body.id] = event.body;
      break;
    case ForestEvent::REMOVE_BODY:
      bodies_.erase(event.body.id);
      break;
    case ForestEvent::RESET:
      clear(false);
      break;
    default:
      break;
  }
}

void GrabManager::drop(const ForestEvent& event) {
  const auto found = held_.find(event.grab.id);
  const bool waits = found != held_.end() && !found->second.in_force;
  if (event.kind == ForestEvent::GRAB && waits) held_.erase(found);
}

// The force of a grab that is over falls for a while where its holder was last.
std::map<std::uint32_t, GrabManager::Held>::iterator GrabManager::forget(
    std::map<std::uint32_t, Held>::iterator entry) {
  if (!entry->second.grab.frame.empty()) gone_[entry->first] = fromMsg(entry->second.grab.holder);
  return held_.erase(entry);
}

std::vector<forest::Grab> GrabManager::settle() {
  const auto& in_force = room_.forest.grabs();
  for (auto entry = held_.begin(); entry != held_.end();)
    entry =
        entry->second.in_force && !in_force.count(entry->first) ? forget(entry) : std::next(entry);
  std::map<std::uint32_t, Pose> falling;
  for (const forest::Reaction& reaction : room_.forest.reactions())
    if (const auto found = gone_.find(reaction.grab); found != gone_.end()) falling.insert(*found);
  gone_ = std::move(falling);
  return room_.forest.ended();
}

void GrabManager::clear(bool waiting_too) {
  for (auto entry = held_.begin(); entry != held_.end();)
    entry = waiting_too || entry->second.in_force ? held_.erase(entry) : std::next(entry);
  bodies_.clear();
  gone_.clear();
  silent_ = 0;
}

// World pose, at the tick, of the frame in which a reaction is told.
Pose GrabManager::frameOf(const forest::Reaction& reaction) const {
  if (reaction.kind == forest::Reaction::GRAB) {
    const auto held = held_.find(reaction.grab);
    if (held != held_.end() && !reaction.frame.empty()) return fromMsg(held->second.grab.holder);
    const auto gone = gone_.find(reaction.grab);
    if (gone != gone_.end()) return gone->second;
  } else {
    const auto body = bodies_.find(reaction.body);
    if (body != bodies_.end()) {
      const Pose now = poseAt(fromMsg(body->second), room_.forest.snapshot().stamp);
      return compose(now, inverse(fromMsg(body->second.offset)));
    }
  }
  return {reaction.point, {}};
}

std::vector<geometry_msgs::WrenchStamped> GrabManager::wrenches() const {
  std::vector<geometry_msgs::WrenchStamped> out;
  for (const forest::Reaction& reaction : room_.forest.reactions()) {
    const FramedWrench wrench = wrenchIn(frameOf(reaction), reaction);
    geometry_msgs::WrenchStamped message;
    message.header.stamp = toStamp(room_.forest.snapshot().stamp);
    message.header.frame_id = reaction.frame.empty() ? room_.options.frame_id : reaction.frame;
    message.wrench.force = toVector(wrench.force);
    message.wrench.torque = toVector(wrench.torque);
    out.push_back(message);
  }
  return out;
}

std::vector<BranchGrab> GrabManager::grabsOf(std::uint32_t tree) const {
  std::vector<BranchGrab> out;
  for (const auto& entry : held_)
    if (entry.second.in_force && entry.second.grab.tree == tree) out.push_back(entry.second.grab);
  return out;
}

std::vector<forest::BranchPoint> GrabManager::heldPoints() const {
  std::vector<forest::BranchPoint> out;
  for (const auto& entry : held_)
    if (entry.second.in_force) {
      const BranchGrab& grab = entry.second.grab;
      out.push_back({grab.tree, static_cast<int>(grab.branch), grab.along});
    }
  return out;
}

}  // namespace vegetation_sim
