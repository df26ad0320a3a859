// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr std::uint32_t MOST_AT_ONCE = 1000;
constexpr double VARIETY = 0.12;  // of people who come together

}  // namespace

crowd::Point AgentCrowd::placeInWorld(const geometry_msgs::Point& point, const Pose& to_world) {
  const Vec3 out = transformed(to_world, Vec3(point.x, point.y, 0.0));
  return {out.x(), out.y()};
}

void AgentCrowd::enqueueHash(std::uint8_t kind, std::uint64_t hash, Nanoseconds stamp) {
  CrowdEvent event;
  event.header.stamp = toStamp(stamp);
  event.kind = kind;
  event.input_hash = hash;
  enqueue(event);
}

void AgentCrowd::onLayout(const ForestLayout& message) {
  acceptInput("forest/layout", [&] {
    checkFrame(message.header.frame_id, options_.frame_id);
    const std::uint64_t hash = fromMsg(message).hash();
    layouts_.keep(hash, message);
    heard_layout_ = hash;
    enqueueHash(CrowdEvent::TRUNKS, hash);
  });
}

void AgentCrowd::onCover(const nav_msgs::OccupancyGrid& message) {
  acceptInput("grass/cover/resistance", [&] {
    checkFrame(message.header.frame_id, options_.frame_id);
    resistanceOf(message);  // checks it
    const Nanoseconds made = fromMsg(message.header.stamp);
    if (awaitsMeadow() && !cover_wait_.hear(made, clock_.stamp())) return;
    const std::uint64_t hash = hashOf(message);
    if (hash == heard_cover_) return;
    covers_.keep(hash, message);
    heard_cover_ = hash;
    // A map of another clock acts at the next tick.
    const Nanoseconds stamp = made + CoverWait::LEAD;
    const bool is_soon = clock_.hasBegun() && stamp > clock_.stamp() &&
                         stamp <= clock_.stamp() + 2 * CoverWait::LEAD;
    enqueueHash(CrowdEvent::COVER, hash, is_soon ? stamp : 0);
  });
}

void AgentCrowd::awaitCover(Nanoseconds stamp) {
  if (!awaitsMeadow()) return;
  cover_wait_.begin(stamp);
  unsent_covers_ += cover_wait_.endWait(
      awaitInputs(options_.frame_wait, [&] { return hasCoverOf(stamp - CoverWait::LEAD); }));
}

bool AgentCrowd::hasCoverOf(Nanoseconds tick) const {
  return covers_subscriber_.getNumPublishers() == 0 || cover_wait_.hasMapOf(tick);
}

// Sensors affect what is sent to them, so they are no events.
void AgentCrowd::onSensor(const SensorInterest& message) {
  acceptInput("sensor",
              [&] { sensors_.hear(message, tf_buffer_, options_.frame_id, lastStamp()); });
}

void AgentCrowd::followRobots(Nanoseconds stamp) {
  for (const CrowdRobots::Change& change : robots_.update(stamp)) {
    CrowdEvent event;
    event.kind = change.gone ? CrowdEvent::REMOVE_ROBOT : CrowdEvent::ROBOT;
    event.robot = toMsg(change.robot);
    if (change.gone && !crowd_.snapshot().robots.count(change.robot.id)) continue;
    inputs_.add(event);
  }
}

void AgentCrowd::enqueueEach(CrowdEvent event, const std::vector<std::uint32_t>& ids) {
  if (ids.size() > inputs_.room())
    throw InvalidInput("ids has " + std::to_string(ids.size()) + " entries, room is for " +
                           std::to_string(inputs_.room()),
                       FaultCode::NO_ROOM);
  for (const std::uint32_t id : ids) {
    event.id = id;
    enqueue(event);
  }
}

void AgentCrowd::checkNumber(const std::vector<std::uint32_t>& ids, Faults& faults) {
  constexpr std::size_t MOST = EventQueue<CrowdEvent>::MOST_OF_CLIENT;
  if (ids.empty() || ids.size() > MOST)
    faults.add("ids has " + std::to_string(ids.size()) + " entries, allowed are 1 to " +
               std::to_string(MOST));
}

void AgentCrowd::addUnknown(std::uint32_t id, Faults& faults) {
  faults.add("ids: walker " + std::to_string(id) + " is unknown", FaultCode::UNKNOWN);
}

void AgentCrowd::checkKnown(const std::vector<std::uint32_t>& ids) const {
  Faults faults;
  checkNumber(ids, faults);
  for (const std::uint32_t id : ids)
    if (!isPart() && !crowd_.find(id)) addUnknown(id, faults);
  faults.throwIfAny();
}

std::size_t AgentCrowd::keepOwn(std::vector<std::uint32_t>& ids) const {
  if (!isPart()) return ids.size();
  ids.erase(std::remove_if(ids.begin(), ids.end(),
                           [this](std::uint32_t id) { return !shard_->mayHave(id); }),
            ids.end());
  return static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), [this](std::uint32_t id) {
    return crowd_.find(id) || shard_->isHanded(id);
  }));
}

bool AgentCrowd::onSpawn(SpawnAgents::Request& request, SpawnAgents::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    if (isPart() && shard_->asksOthers())
      throw InvalidInput("the shard starts, and does not know the ids of all people yet",
                         FaultCode::NOT_AVAILABLE);
    const std::uint32_t count = request.count;
    const auto most = static_cast<std::size_t>(options_.most_walkers);
    const std::size_t room = most - std::min(crowd_.walkers().size() + waitingWalkers(), most);
    const ros::Time stamp = effectOf(request.header.stamp, clock_);
    if (count == 0 || count > MOST_AT_ONCE || count > room || count > inputs_.room(fromMsg(stamp)))
      throw InvalidInput(
          "count = " + std::to_string(count) + " is outside 1 to " +
              std::to_string(std::min<std::size_t>(MOST_AT_ONCE, room)) + ": " +
              std::to_string(crowd_.walkers().size()) +
              " of most_walkers = " + std::to_string(most) + " are there, " +
              std::to_string(waitingWalkers()) + " are to come",
          count == 0 || count > MOST_AT_ONCE ? FaultCode::INVALID_VALUE : FaultCode::NO_ROOM);
    const std::uint64_t last =
        next_id_ + std::uint64_t{count} * (shard_ ? options_.shard->count : 1);
    if (last > crowd::LARGEST_ID)
      throw InvalidInput("ids up to " + std::to_string(last) + " are needed, allowed are 0 to " +
                             std::to_string(crowd::LARGEST_ID),
                         FaultCode::NO_ROOM);
    const Pose to_world = poseOf(request.header.frame_id);
    const Vec3 front = axisX(to_world.orientation);
    Faults faults;
    crowd::Spawn like = fromMsg(request.like, "like: ", faults);
    like.position = placeInWorld(request.like.position, to_world);
    if (like.has_goal) like.goal = placeInWorld(request.like.goal, to_world);
    like.heading += arcTangent(front.y(), front.x());
    FieldChecker checker("like: ", faults);
    describe(checker, like);
    checker.number("goal.x", like.goal.x, "m", {-1e5, 1e5});
    checker.number("goal.y", like.goal.y, "m", {-1e5, 1e5});
    checker.number("spread", request.spread, "m", {0.0, 1e4});
    faults.throwIfAny();
    std::vector<crowd::Spawn> all{like};
    if (count > 1)
      all = crowd::groupOf(like, static_cast<int>(count), request.spread, VARIETY,
                           Random(options_.scene.seed).child(next_id_));
    CrowdEvent event;
    event.kind = CrowdEvent::SPAWN;
    event.header.stamp = stamp;
    for (const crowd::Spawn& spawn : all) {
      event.id = takeId();
      event.spawn = toMsg(spawn);
      enqueue(event);
      response.ids.push_back(event.id);
    }
    return std::to_string(all.size()) + " walkers from the next tick on, or from the stamp";
  });
}

bool AgentCrowd::onRemove(RemoveAgents::Request& request, RemoveAgents::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    std::vector<std::uint32_t> ids = request.ids;
    if (request.all) ids = allIds();
    if (request.all && ids.empty()) return "there are no walkers";
    checkKnown(ids);
    const std::size_t here = keepOwn(ids);
    CrowdEvent event;
    event.kind = CrowdEvent::REMOVE;
    enqueueEach(event, ids);
    return std::to_string(here) + " walkers go at the next tick";
  });
}

bool AgentCrowd::onSetGoal(SetAgentGoal::Request& request, SetAgentGoal::Response& response) {
  return answer(response, [&]() -> std::string {
    refuseInReplay();
    checkKnown(request.ids);
    CrowdEvent event;
    event.kind = CrowdEvent::GOAL;
    event.spawn.has_goal = !request.wander;
    if (!request.wander) {
      const crowd::Point goal =
          placeInWorld(request.goal.point, poseOf(request.goal.header.frame_id));
      event.spawn.goal = toPoint(Vec3(goal.x, goal.y, 0.0));
      for (const std::uint32_t id : request.ids)
        if (crowd_.find(id)) crowd_.checkGoal(id, goal);
    }
    keepOwn(request.ids);
    enqueueEach(event, request.ids);
    return "takes effect at the next tick";
  });
}

CrowdEvent AgentCrowd::tuningEvent(const AgentCrowdConfig& config) const {
  crowd::CrowdSettings settings = fromConfig(config, options_.tuning);
  Faults faults;
  FieldChecker checker("", faults);
  describe(checker, settings);  // the server's own clamp lets NaN pass
  faults.throwIfAny();
  return settingsEvent<CrowdEvent>(settings);
}

}  // namespace vegetation_sim
