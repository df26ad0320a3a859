// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/landscape/near_crowd.h"

namespace vegetation_sim {
namespace {

constexpr double BODY = 3.0;   // reach of a body, and its way until the next message [m]
constexpr double FRESH = 0.5;  // age of a message that stands for the people at a stamp [s]

}  // namespace

void NearCrowd::subscribe(ros::NodeHandle handle, const std::string& topic) {
  subscribeState(handle, topic, 10);
}

bool NearCrowd::accepts(const NearAgents& message) {
  return receive("agents/near", status_, [&] {
    requireSoon(message.header.stamp);
    requireFrame(message.header.frame_id);
    peopleOf(message.agents);
    fromMsg(message.discs);
    return status_;
  });
}

void NearCrowd::apply(const NearAgents& message) {
  receive("agents/near", status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    std::vector<WalkerView> people = peopleOf(message.agents);
    discs_ = fromMsg(message.discs);
    people_ = std::move(people);
    stamp_ = fromMsg(message.header.stamp);
    return {true, std::to_string(people_.size()) + " people"};
  });
}

void NearCrowd::forgetLater(Nanoseconds now) {
  forgetDelayed(now);
  if (stamp_ > now) clear();
}

void NearCrowd::forgetSilent(Nanoseconds now) {
  if (stamp_ != 0 && now - stamp_ > SILENCE) clear();
}

void NearCrowd::clear() {
  people_.clear();
  discs_.clear();
  stamp_ = 0;
}

bool NearCrowd::covers(const Vec3& centre, double radius, Nanoseconds stamp) const {
  if (stamp_ == 0 || secondsBetween(stamp_, stamp) > FRESH) return false;
  return discs_.empty() || vegetation_sim::covers(discs_, {centre.x(), centre.y(), radius + BODY});
}

}  // namespace vegetation_sim
