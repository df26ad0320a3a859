// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/crowd_source.h"

#include <algorithm>
#include <boost/bind/bind.hpp>
#include <cmath>

#include "ros/conversions/crowd_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim::view {

CrowdSource::CrowdSource(ros::NodeHandle nh, const std::string& topic)
    : ground_(nh),
      status_{false, "No people on " + nh.resolveName(topic)},
      subscriber_(nh.subscribe(topic, 2, &CrowdSource::take, this)) {}

void CrowdSource::take(const AgentStates& message) {
  try {
    check(message);
  } catch (const InvalidInput& error) {
    status_ = {false, std::string("Refused a message: ") + error.what()};
    return;
  }
  std::vector<Person> people;
  people.reserve(message.agents.size());
  for (const AgentState& agent : message.agents)
    people.push_back({fromMsg(agent), agent.pose.position.z});
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
