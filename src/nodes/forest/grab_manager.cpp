// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/grab_manager.h"

#include <tf2/exceptions.h>

#include <cmath>

#include "forest/nearest.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double NEAREST_REACH = 2.0;    // [m] from a point to the branch that it means
constexpr double LONGEST_NOTICE = 60.0;  // [s] a request may be that far ahead
constexpr std::size_t MOST_GRABS = 256;  // waiting ones among them
constexpr double STIFFNESS = 2000.0, DAMPING = 40.0, FORCE_LIMIT = 200.0;

double orElse(double value, double otherwise) {
  return value == 0.0 ? otherwise : value;
}

void checkFinite(const char* name, Vec3 value, Range range) {
  Faults faults;
  FieldChecker("", faults).vector(name, value, "m", range);
  faults.throwIfAny();
}

geometry_msgs::TransformStamped lookUp(const GrabDependencies& room, const std::string& frame,
                                       const ros::Time& stamp, const char* name) {
  try {
    return room.tf.lookupTransform(room.options.frame_id, frame, stamp);
  } catch (const tf2::TransformException& error) {
    throw InvalidInput(std::string(name) + " = '" + frame + "' is not known in '" +
                       room.options.frame_id + "': " + error.what());
  }
}

}  // namespace

void GrabManager::requireLive() const {
  if (room_.options.replay) throw InvalidInput("a replay follows its recorded events only");
  if (room_.forest.snapshot().stamp == 0)
    throw InvalidInput("no tick yet: the clock has not started");
}

ForestEvent GrabManager::eventAt(std::uint8_t kind, const ros::Time& stamp) const {
  ForestEvent event;
  event.kind = kind;
  event.header.stamp = stamp;
  if (stamp.isZero()) return event;
  double ahead = secondsBetween(room_.forest.snapshot().stamp, fromMsg(stamp));
  Faults faults;
  FieldChecker("", faults)
      .number("stamp, ahead of the last tick,", ahead, "s", {0.0, LONGEST_NOTICE});
  faults.throwIfAny();
  return event;
}

void GrabManager::enqueue(const ForestEvent& event) {
  if (!room_.inputs.add(event))
    throw InvalidInput(std::to_string(ForestInputs::MOST_WAITING) +
                       " inputs wait for the next tick already");
}

std::shared_ptr<const forest::Tree> GrabManager::grown(std::uint32_t tree) const {
  const auto found = room_.cache.get(room_.forest.layout(), room_.forest.terrain(), tree);
  return {found, &found->tree};
}

GrabManager::Place GrabManager::placeOf(std::uint32_t tree, std::uint32_t branch,
                                        double along) const {
  const auto found = grown(tree);
  const std::vector<forest::Branch>& branches = found->skeleton.branches;
  if (branch >= branches.size())
    throw InvalidInput("branch = " + std::to_string(branch) + " is unknown; tree " +
                       std::to_string(tree) + " has " + std::to_string(branches.size()) +
                       ", from 0");
  Faults faults;
  FieldChecker("", faults).number("along", along, "m", {0.0, branches[branch].length});
  faults.throwIfAny();
  const Pose pose = room_.forest.pose(*found, tree, room_.forest.snapshot().stamp)[branch];
  return {{tree, static_cast<int>(branch), along},
          found->foot + pose.position + along * axisZ(pose.orientation)};
}

GrabManager::Place GrabManager::nearestTo(const geometry_msgs::PointStamped& stamped) const {
  const Vec3 point = inWorld(stamped, "point");
  const auto found = forest::nearestBranch(
      room_.forest.layout(), room_.forest.terrain(), point, NEAREST_REACH,
      [&](std::uint32_t id) -> forest::PosedTree {
        const auto tree = grown(id);
        return {tree, room_.forest.pose(*tree, id, room_.forest.snapshot().stamp)};
      });
  if (!found) throw InvalidInput("no branch within 2 m of point");
  return {found->at, found->point};
}

template <class Request>
GrabManager::Place GrabManager::choose(const Request& request) const {
  if (request.nearest) return nearestTo(request.point);
  return placeOf(request.tree, request.branch, request.along);
}

Vec3 GrabManager::inWorld(const geometry_msgs::PointStamped& stamped, const char* name) const {
  const Vec3 point = fromMsg(stamped.point);
  checkFinite(name, point, {-1e7, 1e7});
  const std::string& frame = stamped.header.frame_id;
  if (frame.empty() || frame == room_.options.frame_id) return point;
  const auto by =
      lookUp(room_, frame, stamped.header.stamp, (std::string(name) + ".frame_id").c_str());
  return transformed(fromMsg(by.transform), point);
}

// @return [m] from the point held to the target
double GrabManager::checkTarget(const BranchGrab& grab, const Vec3& point) const {
  double distance = length(fromMsg(grab.target) - point);
  Faults faults;
  FieldChecker("", faults)
      .number("target, its distance from the point held,", distance, "m",
              {0.0, room_.options.grab_distance});
  faults.throwIfAny();
  forest::checkTarget(*grown(grab.tree), fromMsg(grab.target));
  return distance;
}

// Who asks ahead may find room by then.
void GrabManager::checkRoom(const char* what, const Place& place, const ros::Time& stamp) const {
  if (stamp.isZero())
    room_.forest.snapshot().physics.checkRoom(what, place.at.tree, place.at.branch);
}

// Where its frame is, and the target in it. What tf last said of the frame must be younger than the
// lease: a dead gripper holds nothing.
void GrabManager::tie(const Vec3& point, Held& out) const {
  BranchGrab& grab = out.grab;
  const auto newest = lookUp(room_, grab.frame, ros::Time(0), "frame");
  const Pose frame = fromMsg(newest.transform);
  out.published = newest.header.stamp;
  if (!out.published.isZero()) {  // else static
    const double age = secondsBetween(fromMsg(out.published), room_.forest.snapshot().stamp);
    if (age > grab.lease)
      throw InvalidInput("frame = '" + grab.frame + "' was last told " + std::to_string(age) +
                         " s ago, longer than the lease of " + std::to_string(grab.lease) + " s");
  }
  if (out.keep_offset) grab.offset = toPoint(transformed(inverse(frame), point));
  checkFinite("offset", fromMsg(grab.offset), {-1e3, 1e3});
  grab.holder = toMsg(frame);
  grab.target = toPoint(transformed(frame, fromMsg(grab.offset)));
}

std::string GrabManager::grab(const Grab::Request& request, Grab::Response& response) {
  requireLive();
  ForestEvent event = eventAt(ForestEvent::GRAB, request.stamp);
  if (held_.size() >= MOST_GRABS)
    throw InvalidInput("grabs = " + std::to_string(held_.size() + 1) + " is outside 0 to " +
                       std::to_string(MOST_GRABS));
  const Place place = choose(request);
  Held held;
  held.begins = request.stamp;
  held.keep_offset = request.keep_offset;
  BranchGrab& grab = held.grab;
  grab.id = last_id_ + 1;
  grab.tree = place.at.tree;
  grab.branch = static_cast<std::uint32_t>(place.at.branch);
  grab.along = place.at.along;
  grab.stiffness = orElse(request.stiffness, STIFFNESS);
  grab.damping = orElse(request.damping, DAMPING);
  grab.force_limit = orElse(request.force_limit, FORCE_LIMIT);
  grab.lease = orElse(request.lease, room_.options.grab_lease);
  grab.frame = request.frame;
  grab.offset = request.offset;
  grab.holder.orientation.w = 1.0;
  if (request.frame.empty())
    grab.target = toPoint(inWorld(request.target, "target"));
  else
    tie(place.point, held);
  checkTarget(grab, place.point);
  forest::checkGrab(room_.forest.layout(), *grown(grab.tree), fromMsg(grab));
  checkRoom("grab", place, request.stamp);
  event.grab = grab;
  enqueue(event);
  held_[++last_id_] = held;
  response.id = last_id_;
  response.tree = grab.tree;
  response.branch = grab.branch;
  response.along = grab.along;
  response.point = toPoint(place.point);
  return "grab " + std::to_string(last_id_) + " of tree_" + std::to_string(response.tree) +
         "/branch_" + std::to_string(response.branch);
}

GrabManager::Held& GrabManager::find(std::uint32_t id) {
  const auto found = held_.find(id);
  if (found != held_.end()) return found->second;
  std::string known;
  for (const auto& entry : held_)
    known += (known.empty() ? "" : ", ") + std::to_string(entry.first);
  throw InvalidInput(
      "id = " + std::to_string(id) +
      (known.empty() ? " is unknown; nothing is held" : " is unknown; held are " + known));
}

// A grab that takes hold after `stamp`, zero: after the next tick.
bool GrabManager::waitsLonger(const Held& held, const ros::Time& stamp) {
  return !held.in_force && !held.begins.isZero() && (stamp.isZero() || stamp < held.begins);
}

std::string GrabManager::move(const MoveGrab::Request& request, MoveGrab::Response& response) {
  requireLive();
  Held& held = find(request.id);
  ForestEvent event =
      eventAt(request.renew_only ? ForestEvent::RENEW : ForestEvent::MOVE, request.stamp);
  if (waitsLonger(held, request.stamp))
    throw InvalidInput("id = " + std::to_string(request.id) + " takes hold at " +
                       std::to_string(held.begins.toSec()) + " s; allowed is a stamp from then on");
  BranchGrab moved = held.grab;
  if (!request.renew_only) {
    if (!held.grab.frame.empty())
      throw InvalidInput("id = " + std::to_string(request.id) + " follows frame '" +
                         held.grab.frame + "'; allowed is renew_only");
    moved.target = toPoint(inWorld(request.target, "target"));
  }
  const Place place = placeOf(moved.tree, moved.branch, moved.along);
  const double distance = length(fromMsg(moved.target) - place.point);
  response.distance = request.renew_only ? distance : checkTarget(moved, place.point);
  response.point = toPoint(place.point);
  for (const forest::Reaction& reaction : room_.forest.reactions())
    if (reaction.grab == request.id) response.force = toVector(reaction.force);
  event.grab.id = moved.id;
  event.grab.target = moved.target;
  event.grab.holder = moved.holder;
  enqueue(event);
  return request.renew_only ? "lease renewed" : "moved";
}

std::string GrabManager::release(const Release::Request& request) {
  requireLive();
  ForestEvent event = eventAt(ForestEvent::RELEASE, request.stamp);
  if (!request.all) find(request.id);
  std::size_t count = 0;
  for (auto entry = held_.begin(); entry != held_.end();) {
    const auto& [id, held] = *entry;
    const bool meant = request.all || id == request.id;
    const bool never =  // takes hold
        !held.in_force && (request.stamp.isZero() || request.stamp <= held.begins);
    if (meant && never) room_.inputs.forgetGrab(id);
    event.grab.id = id;
    if (meant && !never) enqueue(event);
    count += meant ? 1 : 0;
    entry = meant && never ? held_.erase(entry) : std::next(entry);
  }
  return std::to_string(count) + " released";
}

std::string GrabManager::push(const ApplyForce::Request& request, ApplyForce::Response& response) {
  requireLive();
  ForestEvent event = eventAt(ForestEvent::FORCE, request.stamp);
  const Place place = choose(request);
  event.force.tree = place.at.tree;
  event.force.branch = static_cast<std::uint32_t>(place.at.branch);
  event.force.along = place.at.along;
  event.force.force = request.force.vector;
  event.force.duration = request.duration;
  fromMsg(event.force, 0);  // checks it
  const std::string& frame = request.force.header.frame_id;
  if (!frame.empty() && frame != room_.options.frame_id) {
    const Pose by =
        fromMsg(lookUp(room_, frame, request.force.header.stamp, "force.frame_id").transform);
    event.force.force = toVector(rotate(by.orientation, fromMsg(request.force.vector)));
  }
  forest::checkPush(room_.forest.layout(), *grown(place.at.tree), fromMsg(event.force, 0));
  checkRoom("push", place, request.stamp);
  enqueue(event);
  response.tree = place.at.tree;
  response.branch = event.force.branch;
  response.along = place.at.along;
  response.point = toPoint(place.point);
  return "pushes tree_" + std::to_string(response.tree) + "/branch_" +
         std::to_string(response.branch);
}

}  // namespace vegetation_sim
