// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/nodes/grab_desk.h"

#include <tf2/exceptions.h>

#include <cmath>

#include "vegetation_sim/forest/nearest.h"
#include "vegetation_sim/ros/grab_conversions.h"
#include "vegetation_sim/ros/stamps.h"

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

geometry_msgs::TransformStamped lookUp(const GrabRoom& room, const std::string& frame,
                                       const ros::Time& stamp, const char* name) {
  try {
    return room.tf.lookupTransform(room.options.frame_id, frame, stamp);
  } catch (const tf2::TransformException& error) {
    throw InvalidInput(std::string(name) + " = '" + frame + "' is not known in '" +
                       room.options.frame_id + "': " + error.what());
  }
}

}  // namespace

void GrabDesk::requireLive() const {
  if (room_.options.replay) throw InvalidInput("a replay follows its recorded events only");
  if (room_.forest.memory().stamp == 0)
    throw InvalidInput("no tick yet: the clock has not started");
}

ForestEvent GrabDesk::eventAt(std::uint8_t kind, const ros::Time& stamp) const {
  ForestEvent event;
  event.kind = kind;
  event.header.stamp = stamp;
  if (stamp.isZero()) return event;
  double ahead = secondsBetween(room_.forest.memory().stamp, fromMsg(stamp));
  Faults faults;
  FieldChecker("", faults)
      .number("stamp, ahead of the last tick,", ahead, "s", {0.0, LONGEST_NOTICE});
  faults.throwIfAny();
  return event;
}

GrabDesk::Place GrabDesk::placeOf(std::uint32_t tree, std::uint32_t branch, double along) const {
  const auto grown = room_.cache.get(room_.forest.layout(), room_.forest.terrain(), tree);
  const std::vector<forest::Branch>& branches = grown->tree.skeleton.branches;
  if (branch >= branches.size())
    throw InvalidInput("branch = " + std::to_string(branch) + " is unknown; tree " +
                       std::to_string(tree) + " has " + std::to_string(branches.size()) +
                       ", from 0");
  Faults faults;
  FieldChecker("", faults).number("along", along, "m", {0.0, branches[branch].length});
  faults.throwIfAny();
  const Pose pose = room_.forest.pose(grown->tree, tree, room_.forest.memory().stamp)[branch];
  return {{tree, static_cast<int>(branch), along},
          grown->tree.foot + pose.position + along * axisZ(pose.orientation)};
}

GrabDesk::Place GrabDesk::nearestTo(const geometry_msgs::PointStamped& stamped) const {
  const Vec3 point = inWorld(stamped, "point");
  const auto found = forest::nearestBranch(
      room_.forest.layout(), room_.forest.terrain(), point, NEAREST_REACH,
      [&](std::uint32_t id) -> forest::PosedTree {
        const auto grown = room_.cache.get(room_.forest.layout(), room_.forest.terrain(), id);
        return {std::shared_ptr<const forest::Tree>(grown, &grown->tree),
                room_.forest.pose(grown->tree, id, room_.forest.memory().stamp)};
      });
  if (!found) throw InvalidInput("no branch within 2 m of point");
  return {found->at, found->point};
}

template <class Request>
GrabDesk::Place GrabDesk::choose(const Request& request) const {
  if (request.nearest) return nearestTo(request.point);
  return placeOf(request.tree, request.branch, request.along);
}

Vec3 GrabDesk::inWorld(const geometry_msgs::PointStamped& stamped, const char* name) const {
  const Vec3 point = fromMsg(stamped.point);
  checkFinite(name, point, {-1e7, 1e7});
  const std::string& frame = stamped.header.frame_id;
  if (frame.empty() || frame == room_.options.frame_id) return point;
  const auto by =
      lookUp(room_, frame, stamped.header.stamp, (std::string(name) + ".frame_id").c_str());
  return transformed(fromMsg(by.transform), point);
}

double GrabDesk::checkDistance(const Vec3& held, const Vec3& target) const {
  double distance = length(target - held);
  Faults faults;
  FieldChecker("", faults)
      .number("target, its distance from the point held,", distance, "m",
              {0.0, room_.options.grab_distance});
  faults.throwIfAny();
  return distance;
}

// What tf last said of the frame must be younger than the lease: a dead gripper holds nothing.
void GrabDesk::tie(const std::string& frame, Held& out) const {
  const auto newest = lookUp(room_, frame, ros::Time(0), "frame");
  out.told = newest.header.stamp;
  out.grab.holder = toMsg(fromMsg(newest.transform));
  if (out.told.isZero()) return;  // static
  const double age = secondsBetween(fromMsg(out.told), room_.forest.memory().stamp);
  if (age > out.grab.lease)
    throw InvalidInput("frame = '" + frame + "' was last told " + std::to_string(age) +
                       " s ago, longer than the lease of " + std::to_string(out.grab.lease) + " s");
}

void GrabDesk::aim(const Grab::Request& request, const Vec3& held, Held& out) const {
  out.grab.frame = request.frame;
  out.grab.holder.orientation.w = 1.0;
  if (request.frame.empty()) {
    out.grab.target = toPoint(inWorld(request.target, "target"));
  } else {
    tie(request.frame, out);
    const Pose frame = fromMsg(out.grab.holder);
    out.grab.offset =
        request.keep_offset ? toPoint(transformed(inverse(frame), held)) : request.offset;
    checkFinite("offset", fromMsg(out.grab.offset), {-1e3, 1e3});
    out.grab.target = toPoint(transformed(frame, fromMsg(out.grab.offset)));
  }
  checkDistance(held, fromMsg(out.grab.target));
}

std::string GrabDesk::grab(const Grab::Request& request, Grab::Response& response) {
  requireLive();
  ForestEvent event = eventAt(ForestEvent::GRAB, request.stamp);
  if (held_.size() >= MOST_GRABS)
    throw InvalidInput("grabs = " + std::to_string(held_.size() + 1) + " is outside 0 to " +
                       std::to_string(MOST_GRABS));
  const Place place = choose(request);
  Held held;
  held.grab.id = last_id_ + 1;
  held.grab.tree = place.at.tree;
  held.grab.branch = static_cast<std::uint32_t>(place.at.branch);
  held.grab.along = place.at.along;
  held.grab.stiffness = orElse(request.stiffness, STIFFNESS);
  held.grab.damping = orElse(request.damping, DAMPING);
  held.grab.force_limit = orElse(request.force_limit, FORCE_LIMIT);
  held.grab.lease = orElse(request.lease, room_.options.grab_lease);
  aim(request, place.point, held);
  fromMsg(held.grab);  // checks it
  event.grab = held.grab;
  room_.inputs.addInteraction(event);
  held_[++last_id_] = held;
  response.id = last_id_;
  response.tree = held.grab.tree;
  response.branch = held.grab.branch;
  response.along = held.grab.along;
  response.point = toPoint(place.point);
  return "grab " + std::to_string(last_id_) + " of tree_" + std::to_string(response.tree) +
         "/branch_" + std::to_string(response.branch);
}

GrabDesk::Held& GrabDesk::find(std::uint32_t id) {
  const auto found = held_.find(id);
  if (found != held_.end()) return found->second;
  std::string known;
  for (const auto& entry : held_)
    known += (known.empty() ? "" : ", ") + std::to_string(entry.first);
  throw InvalidInput(
      "id = " + std::to_string(id) +
      (known.empty() ? " is unknown; nothing is held" : " is unknown; held are " + known));
}

std::string GrabDesk::move(const MoveGrab::Request& request, MoveGrab::Response& response) {
  requireLive();
  Held& held = find(request.id);
  ForestEvent event = eventAt(ForestEvent::MOVE, request.stamp);
  event.grab.id = held.grab.id;
  event.grab.target = held.grab.target;
  event.grab.holder = held.grab.holder;
  if (!request.renew_only) {
    if (!held.grab.frame.empty())
      throw InvalidInput("id = " + std::to_string(request.id) + " follows frame '" +
                         held.grab.frame + "'; allowed is renew_only");
    event.grab.target = toPoint(inWorld(request.target, "target"));
  }
  const Place place = placeOf(held.grab.tree, held.grab.branch, held.grab.along);
  response.distance = checkDistance(place.point, fromMsg(event.grab.target));
  response.point = toPoint(place.point);
  for (const forest::Reaction& reaction : room_.forest.reactions())
    if (reaction.grab == request.id) response.force = toVector(reaction.force);
  room_.inputs.addInteraction(event);
  if (request.stamp.isZero()) held.grab.target = event.grab.target;
  return request.renew_only ? "lease renewed" : "moved";
}

std::string GrabDesk::release(const Release::Request& request) {
  requireLive();
  ForestEvent event = eventAt(ForestEvent::RELEASE, request.stamp);
  if (!request.all) find(request.id);
  std::size_t count = 0;
  for (auto entry = held_.begin(); entry != held_.end();) {
    const std::uint32_t id = entry->first;
    const bool meant = request.all || id == request.id;
    const bool waits = !entry->second.in_force && request.stamp.isZero();
    if (meant && waits) room_.inputs.forgetGrab(id);
    event.grab.id = id;
    if (meant && !waits) room_.inputs.addInteraction(event);
    count += meant ? 1 : 0;
    entry = meant && waits ? held_.erase(entry) : std::next(entry);
  }
  return std::to_string(count) + " released";
}

std::string GrabDesk::push(const ApplyForce::Request& request, ApplyForce::Response& response) {
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
  room_.inputs.addInteraction(event);
  response.tree = place.at.tree;
  response.branch = event.force.branch;
  response.along = place.at.along;
  response.point = toPoint(place.point);
  return "pushes tree_" + std::to_string(response.tree) + "/branch_" +
         std::to_string(response.branch);
}

}  // namespace vegetation_sim
