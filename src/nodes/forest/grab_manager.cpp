// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/forest/grab_manager.h"

#include <cmath>
#include <set>
#include <utility>

#include "ros/conversions/grab_conversions.h"
#include "ros/conversions/optional_numbers.h"
#include "ros/services/request_checks.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double NEAREST_REACH = 2.0;    // [m] from a point to the branch that it means
constexpr double LONGEST_NOTICE = 60.0;  // [s] a request may be that far ahead
constexpr std::size_t MOST_GRABS = 256;  // waiting ones among them

// Reads the numbers that the request gives; the others keep their defaults.
void readSpring(const Grab::Request& request, forest::Grab& grab) {
  Faults faults;
  OptionalNumbers numbers("", faults);
  numbers.read("stiffness", request.has_stiffness, request.stiffness, grab.stiffness);
  numbers.read("damping", request.has_damping, request.damping, grab.damping);
  numbers.read("force_limit", request.has_force_limit, request.force_limit, grab.force_limit);
  numbers.read("lease", request.has_lease, request.lease, grab.lease);
  faults.throwIfAny();
}

geometry_msgs::TransformStamped lookUp(const GrabDependencies& node, const std::string& frame,
                                       const ros::Time& stamp, const char* name) {
  return transformToWorld(node.tf, node.options.frame_id, frame, stamp, name);
}

}  // namespace

Pose holderPose(const geometry_msgs::TransformStamped& transform) {
  Pose out = fromMsg(transform.transform);
  out.orientation = normalized(out.orientation);
  return out;
}

void GrabManager::requireLive() const {
  if (node_.options.replay)
    throw InvalidInput("a replay follows its recorded events only", FaultCode::NOT_AVAILABLE);
}

ForestInput GrabManager::eventAt(ForestInput::Kind kind, const ros::Time& stamp) const {
  ForestInput event;
  event.kind = kind;
  event.stamp = fromMsg(stamp);
  if (stamp.isZero()) return event;
  double ahead = secondsBetween(node_.forest.snapshot().stamp, fromMsg(stamp));
  Faults faults;
  FieldChecker("", faults)
      .number("stamp, ahead of the last tick,", ahead, "s", {0.0, LONGEST_NOTICE});
  faults.throwIfAny();
  return event;
}

void GrabManager::enqueue(const ForestInput& event) {
  if (!node_.inputs.add(event))
    throw InvalidInput(ForestInputs::describeFull(), FaultCode::NO_ROOM);
}

std::shared_ptr<const forest::Tree> GrabManager::grown(std::uint32_t tree) const {
  const auto found = node_.cache.get(node_.forest, tree);
  return {found, &found->tree};
}

GrabManager::Place GrabManager::placeOf(std::uint32_t tree, std::uint32_t branch,
                                        double along) const {
  const auto found = grown(tree);
  const std::vector<forest::Branch>& branches = found->skeleton.branches;
  if (branch >= branches.size())
    throw InvalidInput("branch = " + std::to_string(branch) + " is unknown; tree " +
                           std::to_string(tree) + " has " + std::to_string(branches.size()) +
                           ", from 0",
                       FaultCode::UNKNOWN);
  if (branches[branch].broken)
    throw InvalidInput(
        "branch = " + std::to_string(branch) + " of tree " + std::to_string(tree) + " has come off",
        FaultCode::UNKNOWN);
  Faults faults;
  FieldChecker("", faults).number("along", along, "m", {0.0, branches[branch].length});
  faults.throwIfAny();
  const Pose pose = node_.forest.pose(*found, tree, node_.forest.snapshot().stamp)[branch];
  return {{tree, static_cast<int>(branch), along},
          found->foot + pose.position + along * axisZ(pose.orientation),
          axisZ(pose.orientation)};
}

// A jaw keeps the direction that the branch has now.
void GrabManager::setDirection(forest::Grab& grab) const {
  if (grab.jaw_length == 0.0) return;
  const Place place =
      placeOf(grab.point.tree, static_cast<std::uint32_t>(grab.point.branch), grab.point.along);
  grab.direction = rotate(conjugate(grab.holder.orientation), place.axis);
}

Vec3 GrabManager::pointOf(const forest::Grab& grab) const {
  return placeOf(grab.point.tree, static_cast<std::uint32_t>(grab.point.branch), grab.point.along)
      .point;
}

std::optional<forest::Nearest> GrabManager::searchNear(
    const geometry_msgs::PointStamped& stamped,
    const std::function<bool(std::uint32_t)>& is_searched) const {
  return forest::nearestBranch(
      node_.forest.layout(), node_.forest.terrain(), inWorld(stamped, "point"), NEAREST_REACH,
      [&](std::uint32_t id) -> forest::PosedTree {
        if (!is_searched(id)) return {};
        const auto tree = grown(id);
        return {tree, node_.forest.pose(*tree, id, node_.forest.snapshot().stamp)};
      });
}

forest::Nearest GrabManager::findNearest(const geometry_msgs::PointStamped& point) const {
  const auto found =
      searchNear(point, [this](std::uint32_t id) { return node_.forest.owners().owns(id); });
  if (!found) throw InvalidInput("no branch within 2 m of point", FaultCode::NOTHING_FOUND);
  return *found;
}

std::vector<std::uint32_t> GrabManager::listOwnersNear(
    const geometry_msgs::PointStamped& point) const {
  std::set<std::uint32_t> owners;
  searchNear(point, [&](std::uint32_t id) {
    owners.insert(node_.forest.owners().ownerOf(id));
    return false;
  });
  return {owners.begin(), owners.end()};
}

template <class ServiceRequest>
GrabManager::Place GrabManager::choose(const ServiceRequest& request) const {
  if (request.nearest) {
    const forest::Nearest found = findNearest(request.point);
    return {found.at, found.point, Vec3::UnitZ()};
  }
  const Place out = placeOf(request.tree, request.branch, request.along);
  node_.forest.owners().requireOwned("request", request.tree);
  return out;
}

Vec3 GrabManager::inWorld(const geometry_msgs::PointStamped& stamped, const char* name) const {
  const Vec3 point = fromMsg(stamped.point);
  checkFinite(name, point, {-1e7, 1e7});
  const std::string& frame = stamped.header.frame_id;
  if (frame.empty() || frame == node_.options.frame_id) return point;
  const auto by =
      lookUp(node_, frame, stamped.header.stamp, (std::string(name) + ".frame_id").c_str());
  return transformed(fromMsg(by.transform), point);
}

// Returns the distance from the point held to the target [m].
double GrabManager::checkTarget(const forest::Grab& grab, const Vec3& point) const {
  double distance = length(grab.target - point);
  Faults faults;
  FieldChecker("", faults)
      .number("target, its distance from the point held,", distance, "m",
              {0.0, node_.options.grab_distance});
  faults.throwIfAny();
  forest::checkTarget(*grown(grab.point.tree), grab.target);
  return distance;
}

// A request for a later tick may find room by then.
void GrabManager::checkRoom(const char* what, const Place& place, const ros::Time& stamp) const {
  if (stamp.isZero())
    node_.forest.snapshot().physics.checkRoom(what, place.at.tree, place.at.branch);
}

// Sets the holder's pose and the target from the grab's frame. Its transform must be younger than
// the lease: a gripper that is no longer reported holds nothing.
void GrabManager::setByFrame(const Vec3& point, const geometry_msgs::TransformStamped& newest,
                             forest::Grab& grab, Request& request) const {
  request.published = newest.header.stamp;
  if (!request.published.isZero()) {  // else static
    const double age = secondsBetween(fromMsg(request.published), node_.forest.snapshot().stamp);
    if (age > grab.lease)
      throw InvalidInput("frame = " + inQuotes(grab.frame) + " has a transform that is " +
                             std::to_string(age) + " s old, longer than the lease of " +
                             std::to_string(grab.lease) + " s",
                         FaultCode::NO_TRANSFORM);
  }
  grab.holder = holderPose(newest);
  if (request.keep_offset) grab.offset = transformed(inverse(grab.holder), point);
  checkFinite("offset", grab.offset, {-1e3, 1e3});
  grab.target = transformed(grab.holder, grab.offset);
}

// The queue may write a checkpoint, which has the grab only if it is known before.
void GrabManager::enqueueGrab(const ForestInput& event, const Request& request) {
  const std::uint32_t before = std::exchange(last_id_, event.grab.id);
  requests_[last_id_] = request;
  try {
    enqueue(event);
  } catch (...) {
    requests_.erase(last_id_);
    last_id_ = before;
    throw;
  }
}

std::string GrabManager::grab(const Grab::Request& request, Grab::Response& response) {
  requireLive();
  ForestInput event = eventAt(ForestInput::GRAB, request.stamp);
  if (requests_.size() >= MOST_GRABS)
    throw InvalidInput("grabs = " + std::to_string(requests_.size() + 1) + " is outside 0 to " +
                           std::to_string(MOST_GRABS),
                       FaultCode::NO_ROOM);
  const Place place = choose(request);
  Request accepted{request.keep_offset != 0, event.stamp, ros::Time(), false};
  forest::Grab& grab = event.grab;
  grab.id = nextIdOf(node_.forest.shard(), last_id_ + 1);
  grab.point = place.at;
  grab.lease = node_.options.grab_lease;
  grab.frame = request.frame;
  grab.jaw_length = request.jaw_length;
  readSpring(request, grab);
  if (grab.frame.empty()) {
    grab.target = inWorld(request.target, "target");
  } else {
    grab.offset = fromMsg(request.offset);
    setByFrame(place.point, lookUp(node_, grab.frame, ros::Time(0), "frame"), grab, accepted);
  }
  setDirection(grab);
  checkTarget(grab, place.point);
  forest::checkGrab(node_.forest.layout(), *grown(grab.point.tree), grab);
  checkRoom("grab", place, request.stamp);
  enqueueGrab(event, accepted);
  if (!grab.frame.empty()) node_.on_change();
  response.id = last_id_;
  response.tree = place.at.tree;
  response.branch = static_cast<std::uint32_t>(place.at.branch);
  response.along = place.at.along;
  response.point = toPoint(place.point);
  return "grab " + std::to_string(last_id_) + " of tree_" + std::to_string(response.tree) +
         "/branch_" + std::to_string(response.branch);
}

GrabManager::Request& GrabManager::find(std::uint32_t id) {
  const auto found = requests_.find(id);
  if (found != requests_.end()) return found->second;
  const Shard& shard = node_.forest.shard();
  if (id > 0 && shardOfId(id, shard.count) != shard.index)
    throw InvalidInput("id = " + std::to_string(id) + " is of shard " +
                           std::to_string(shardOfId(id, shard.count)) + " of " +
                           std::to_string(shard.count) + ", this is shard " +
                           std::to_string(shard.index),
                       FaultCode::UNKNOWN);
  std::string known;
  for (const auto& entry : requests_)
    known += (known.empty() ? "" : ", ") + std::to_string(entry.first);
  const std::string end = history_.describeEnd(id);
  throw InvalidInput("id = " + std::to_string(id) + (end.empty() ? " is unknown" : end) +
                         (known.empty() ? "; nothing is held" : "; held are " + known),
                     FaultCode::UNKNOWN);
}

const forest::Grab& GrabManager::grabOf(std::uint32_t id) const {
  const auto found = node_.forest.grabs().find(id);
  if (found != node_.forest.grabs().end()) return found->second;
  if (const forest::Grab* waiting = node_.inputs.waitingGrab(id)) return *waiting;
  throw InvalidInput("id = " + std::to_string(id) + " is over", FaultCode::UNKNOWN);
}

std::string GrabManager::move(const MoveGrab::Request& request, MoveGrab::Response& response) {
  requireLive();
  const Nanoseconds begins = find(request.id).begins;
  ForestInput event =
      eventAt(request.renew_only ? ForestInput::RENEW : ForestInput::MOVE, request.stamp);
  if (!isInForce(request.id) && begins != 0 && (event.stamp == 0 || event.stamp < begins))
    throw InvalidInput("id = " + std::to_string(request.id) + " takes hold at " +
                       std::to_string(toStamp(begins).toSec()) +
                       " s; allowed is a stamp from then on");
  event.grab = grabOf(request.id);
  forest::Grab& moved = event.grab;
  if (!request.renew_only) {
    if (!moved.frame.empty())
      throw InvalidInput("id = " + std::to_string(request.id) + " follows frame " +
                         inQuotes(moved.frame) + "; allowed is renew_only");
    moved.target = inWorld(request.target, "target");
  }
  const Vec3 point = pointOf(moved);
  response.distance = request.renew_only ? length(moved.target - point) : checkTarget(moved, point);
  response.point = toPoint(point);
  for (const forest::Reaction& reaction : node_.forest.reactions())
    if (reaction.grab == request.id) response.force = toVector(reaction.force);
  enqueue(event);
  return request.renew_only ? "lease renewed" : "moved";
}

std::string GrabManager::release(const Release::Request& request) {
  requireLive();
  ForestInput event = eventAt(ForestInput::RELEASE, request.stamp);
  if (!request.all) find(request.id);
  std::vector<std::uint32_t> in_force, waiting;
  for (const auto& [id, held] : requests_) {
    if (!request.all && id != request.id) continue;
    const bool never_begins = !isInForce(id) && (event.stamp == 0 || event.stamp <= held.begins);
    (never_begins ? waiting : in_force).push_back(id);
  }
  if (in_force.size() > node_.inputs.room(event.stamp))
    throw InvalidInput(std::to_string(in_force.size()) + " grabs to release, and " +
                           std::to_string(node_.inputs.room(event.stamp)) +
                           " inputs that still fit",
                       FaultCode::NO_ROOM);
  for (const std::uint32_t id : waiting) {
    node_.inputs.forgetGrab(id);
    history_.addUnheld(id, GrabStatus::RELEASED, node_.forest.snapshot().stamp);
    requests_.erase(id);
  }
  if (!waiting.empty()) node_.on_change();
  for (const std::uint32_t id : in_force) {
    event.grab.id = id;
    enqueue(event);
  }
  return std::to_string(waiting.size() + in_force.size()) + " released";
}

std::string GrabManager::push(const ApplyForce::Request& request, ApplyForce::Response& response) {
  requireLive();
  ForestInput event = eventAt(ForestInput::FORCE, request.stamp);
  const Place place = choose(request);
  BranchForce asked;
  asked.duration = request.duration;
  asked.force = request.force.vector;
  asked.whole_tree = request.whole_tree;
  event.push = fromMsg(asked);
  event.push.point = place.at;
  const std::string& frame = request.force.header.frame_id;
  if (!frame.empty() && frame != node_.options.frame_id) {
    const Pose by =
        fromMsg(lookUp(node_, frame, request.force.header.stamp, "force.frame_id").transform);
    event.push.force = rotate(by.orientation, event.push.force);
  }
  forest::checkPush(node_.forest.layout(), *grown(place.at.tree), event.push);
  checkRoom("push", place, request.stamp);
  if (request.whole_tree)
    node_.forest.snapshot().physics.checkRoomForTree("push", *grown(place.at.tree), place.at.tree);
  enqueue(event);
  response.tree = place.at.tree;
  response.branch = static_cast<std::uint32_t>(place.at.branch);
  response.along = place.at.along;
  response.point = toPoint(place.point);
  return "pushes tree_" + std::to_string(response.tree) + "/branch_" +
         std::to_string(response.branch);
}

std::string GrabManager::cut(const CutBranch::Request& request, CutBranch::Response& response) {
  requireLive();
  ForestInput event = eventAt(ForestInput::CUT, request.stamp);
  event.cut = {request.tree, static_cast<int>(request.branch)};
  if (request.nearest) {
    const forest::BranchPoint found = findNearest(request.point).at;
    event.cut = {found.tree, found.branch};
  }
  forest::checkCut(node_.forest.layout(), *grown(event.cut.tree), event.cut);
  node_.forest.owners().requireOwned("cut", event.cut.tree);
  const auto branch = static_cast<std::uint32_t>(event.cut.branch);
  const Place joint = placeOf(event.cut.tree, branch, 0.0);
  enqueue(event);
  response.tree = event.cut.tree;
  response.branch = branch;
  response.point = toPoint(joint.point);
  return "cuts tree_" + std::to_string(response.tree) + "/branch_" + std::to_string(branch);
}

}  // namespace vegetation_sim
