// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <tf2/exceptions.h>

#include <algorithm>

#include "forest/contact/contact_body.h"
#include "nodes/forest/grab_manager.h"
#include "nodes/snapshots/event_inputs.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_REQUESTS = 4096, REQUEST_BYTES = 22, LARGEST_STATUS = 1u << 16;

void archiveHistory(Archive& a, GrabHistory::State& state) {
  a.map(
      "grabs held", state.since, MOST_REQUESTS, sizeof(std::uint32_t) + sizeof(Nanoseconds),
      [&a](std::uint32_t& id) { a.integer("grab held", id); },
      [&a](std::uint32_t, Nanoseconds& since) { a.stamp("held since", since); });
  std::vector<std::string> ended;
  for (const GrabStatus& status : state.ended) ended.push_back(bytesOf(status));
  a.list("grabs ended", ended, GrabHistory::MOST_ENDED, sizeof(std::uint32_t),
         [&a](std::string& bytes) { a.text("grab ended", bytes, LARGEST_STATUS); });
  if (!a.reads()) return;
  for (std::string& bytes : ended) state.ended.push_back(messageOf<GrabStatus>(std::move(bytes)));
}

}  // namespace

// Uses the transform of the tick itself if tf has it, else the newest one.
bool GrabManager::followOne(const forest::Grab& grab, Request& request, Nanoseconds stamp) {
  const std::string& world = node_.options.frame_id;
  geometry_msgs::TransformStamped newest = lookup_.find(grab.frame);
  const ros::Time published = newest.header.stamp;
  if (!published.isZero() && published <= request.published) return false;
  const ros::Time tick = toStamp(stamp);
  if (published > tick && node_.tf.canTransform(world, grab.frame, tick))
    newest = node_.tf.lookupTransform(world, grab.frame, tick);
  ForestInput event;
  event.kind = ForestInput::MOVE;
  event.grab = grab;
  event.grab.holder = holderPose(newest);
  event.grab.target = transformed(event.grab.holder, grab.offset);
  checkTarget(event.grab, pointOf(grab));
  request.published = published;
  node_.inputs.addFirst(event);
  return true;
}

void GrabManager::follow(Nanoseconds stamp, const Report& report) {
  silent_ = 0;
  if (node_.options.replay) return;
  lookup_.begin(stamp);
  for (const auto& [id, grab] : node_.forest.grabs()) {
    if (grab.frame.empty()) continue;
    try {
      silent_ += followOne(grab, requests_[id], stamp) ? 0 : 1;
    } catch (const tf2::TransformException&) {
      ++silent_;  // the target stays until the lease ends
    } catch (const InvalidInput& error) {
      ++silent_;
      report("frame of grab " + std::to_string(id), error.what());
    }
  }
}

geometry_msgs::TransformStamped GrabManager::awaitFrame(const std::string& frame) {
  try {
    return lookup_.find(frame);
  } catch (const tf2::TransformException& error) {
    throw InvalidInput("frame = " + inQuotes(frame) + " is not known in " +
                           inQuotes(node_.options.frame_id) + ": " + error.what(),
                       FaultCode::NO_TRANSFORM);
  }
}

void GrabManager::followFrame(ForestInput& event) {
  if (event.kind != ForestInput::GRAB || node_.options.replay) return;
  if (event.grab.frame.empty()) return setDirection(event.grab);
  const auto found = requests_.find(event.grab.id);
  if (found == requests_.end()) return;
  const Vec3 point = pointOf(event.grab);
  setByFrame(point, awaitFrame(event.grab.frame), event.grab, found->second);
  setDirection(event.grab);
  checkTarget(event.grab, point);
}

bool GrabManager::update() {
  const Nanoseconds stamp = node_.forest.snapshot().stamp;
  for (auto entry = requests_.begin(); entry != requests_.end();) {
    auto& [id, request] = *entry;
    request.begun = request.begun || isInForce(id);
    const bool over = !isInForce(id) && !node_.inputs.waitingGrab(id);
    if (over && !request.begun) history_.addUnheld(id, GrabStatus::REFUSED, stamp);
    entry = over ? requests_.erase(entry) : std::next(entry);
  }
  return history_.update(node_.forest.grabs(), stamp);
}

void GrabManager::clear() {
  for (const auto& [id, request] : requests_)
    if (!request.begun) history_.addUnheld(id, GrabStatus::RESET, node_.forest.snapshot().stamp);
  requests_.clear();
  silent_ = 0;
}

// Returns the world pose, at the tick, of the frame in which a reaction is reported.
Pose GrabManager::frameOf(const forest::Reaction& reaction) const {
  if (reaction.kind == forest::Reaction::GRAB) {
    if (!reaction.frame.empty()) return reaction.holder;
  } else {
    const auto body = node_.forest.bodies().find(reaction.body);
    if (body != node_.forest.bodies().end())
      return compose(poseAt(body->second, node_.forest.snapshot().stamp),
                     inverse(body->second.in_frame));
  }
  return {reaction.point, {}};
}

ContactForces GrabManager::forces() const {
  ContactForces out;
  out.header.stamp = toStamp(node_.forest.snapshot().stamp);
  out.header.frame_id = node_.options.frame_id;
  for (const forest::Reaction& reaction : node_.forest.reactions())
    out.forces.push_back(toMsg(reaction, frameOf(reaction)));
  return out;
}

GrabStatuses GrabManager::statuses() const {
  GrabStatuses out = history_.message(node_.forest.snapshot().stamp);
  out.header.frame_id = node_.options.frame_id;
  return out;
}

std::vector<BranchGrab> GrabManager::grabsOf(std::uint32_t tree) const {
  std::vector<BranchGrab> out;
  for (const auto& [id, grab] : node_.forest.grabs())
    if (grab.point.tree == tree) out.push_back(toMsg(grab));
  return out;
}

std::vector<forest::BranchPoint> GrabManager::heldPoints() const {
  std::vector<forest::BranchPoint> out;
  for (const auto& entry : node_.forest.grabs()) out.push_back(entry.second.point);
  return out;
}

void GrabManager::archive(Archive& a, State& state) {
  a.map(
      "requests", state.requests, MOST_REQUESTS, REQUEST_BYTES,
      [&a](std::uint32_t& id) { a.integer("request", id); },
      [&a](std::uint32_t, Request& request) {
        a.flag("keep_offset", request.keep_offset);
        a.stamp("request begins", request.begins);
        Nanoseconds published = fromMsg(request.published);
        a.stamp("transform of a request", published);
        if (a.reads()) request.published = toStamp(published);
        a.flag("request has begun", request.begun);
      });
  archiveHistory(a, state.history);
  a.integer("last grab", state.last_id);
}

void GrabManager::restore(const State& state) {
  requests_ = state.requests;
  last_id_ = state.last_id;
  silent_ = 0;
  history_.restore(state.history, node_.forest.grabs());
}

void GrabManager::addRequest(const ForestInput& event) {
  requests_.emplace(event.grab.id, Request{false, event.stamp, ros::Time(), false});
  last_id_ = std::max(last_id_, event.grab.id);
}

}  // namespace vegetation_sim
