// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/crowd_events.h"

#include "ros/conversions/crowd_conversions.h"

namespace vegetation_sim {
namespace {

void spawn(const CrowdEvent& event, crowd::Crowd& crowd) {
  Faults faults;
  const crowd::Spawn spawn = fromMsg(event.spawn, "spawn: ", faults);
  faults.throwIfAny();
  crowd.spawn(spawn, event.id);
}

}  // namespace

void applyToCrowd(const CrowdEvent& event, crowd::Crowd& crowd) {
  switch (event.kind) {
    case CrowdEvent::ROBOT:
      crowd.setRobot(fromMsg(event.robot));
      break;
    case CrowdEvent::REMOVE_ROBOT:
      crowd.removeRobot(event.robot.id);
      break;
    case CrowdEvent::SPAWN:
      spawn(event, crowd);
      break;
    case CrowdEvent::REMOVE:
      crowd.remove(event.id);
      break;
    case CrowdEvent::GOAL:
      if (event.spawn.has_goal)
        crowd.setGoal(event.id, {event.spawn.goal.x, event.spawn.goal.y});
      else
        crowd.setWandering(event.id);
      break;
    default:
      throw InvalidInput("kind = " + std::to_string(event.kind) + " is outside 0 to 9");
  }
}

}  // namespace vegetation_sim
