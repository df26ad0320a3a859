// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/crowd_source.h"

#include <rviz/validate_floats.h>

#include <algorithm>
#include <boost/bind/bind.hpp>
#include <cmath>

#include "vegetation_sim/ros/crowd_conversions.h"
#include "vegetation_sim/ros/stamps.h"

namespace vegetation_sim::view {
namespace {

constexpr Nanoseconds SILENCE = 3 * NANOSECONDS_PER_SECOND;
constexpr double LOWEST = 0.1, HIGHEST = 5.0;  // [m] of a body

// Empty: it can be drawn.
std::string faultOf(const AgentState& agent) {
  bool finite = rviz::validateFloats(agent.pose) && rviz::validateFloats(agent.velocity) &&
                std::isfinite(agent.gait);
  for (std::size_t i = 0; i < 2; ++i)
    finite =
        finite && rviz::validateFloats(agent.feet[i]) && rviz::validateFloats(agent.feet_lag[i]);
  const std::string who = "agent " + std::to_string(agent.id);
  if (!finite) return who + " has a value that is no finite number";
  if (!(agent.height >= LOWEST && agent.height <= HIGHEST))
    return who + ": height = " + std::to_string(agent.height) + " m is not within 0.1 to 5";
  return {};
}

}  // namespace

CrowdSource::CrowdSource(ros::NodeHandle nh, const std::string& topic)
    : ground_(nh),
      status_{false, "No people on " + nh.resolveName(topic)},
      subscriber_(nh.subscribe(topic, 2, &CrowdSource::take, this)) {}

void CrowdSource::take(const AgentStates& message) {
  std::vector<Person> people;
  people.reserve(message.agents.size());
  for (const AgentState& agent : message.agents) {
    const std::string fault = faultOf(agent);
    if (!fault.empty()) {
      status_ = {false, "Refused a message: " + fault};
      return;
    }
    people.push_back({fromMsg(agent), agent.pose.position.z});
  }
  people_ = std::move(people);
  stamp_ = fromMsg(message.header.stamp);
  frame_ = message.header.frame_id;
  ++messages_;
  status_ = {true, std::to_string(people_.size()) + " people"};
}

void CrowdSource::forgetState(Nanoseconds now) {
  heard_ = std::min(heard_, now);
  if (messages_ > 0 && stamp_ > now) forgetAll("Waiting for a message: time went back");
}

void CrowdSource::watch(Nanoseconds now) {
  if (messages_ != watched_) {
    watched_ = messages_;
    heard_ = now;
  } else if (!people_.empty() && now - heard_ > SILENCE) {
    forgetAll("Waiting: no message for 3 s");
  }
}

void CrowdSource::forgetAll(const char* why) {
  people_.clear();
  ++messages_;
  status_ = {false, why};
}

}  // namespace vegetation_sim::view
