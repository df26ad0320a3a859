// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/replicas/subscribed_crowd.h"

#include <algorithm>
#include <cmath>

#include "crowd/body/gait.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim {
namespace {

constexpr double LONGEST_EXTRAPOLATION = 0.25;  // [s]

}  // namespace

crowd::Walker walkOn(crowd::Walker walker, double seconds) {
  const double since = std::clamp(seconds, 0.0, LONGEST_EXTRAPOLATION);
  walker.position = walker.position + since * walker.velocity;
  crowd::advanceGait(since * crowd::speedOf(walker), walker);
  return walker;
}

void SubscribedCrowd::subscribe(ros::NodeHandle handle, const std::string& topic) {
  status_ = {false, "No people on " + handle.resolveName(topic)};
  subscribe_full_ = [this, handle, topic]() mutable { subscribeState(handle, topic, 10); };
  subscribe_full_();
  subscribeMotions(handle, topic);
}

void SubscribedCrowd::listen(bool is_wanted) {
  if (has_view_ || !subscribe_full_ || is_wanted == !subscribers_.empty()) return;
  if (is_wanted)
    subscribe_full_();
  else
    subscribers_.clear();
}

void SubscribedCrowd::subscribeView(ros::NodeHandle handle, const std::string& topic) {
  status_ = {false, "No people on " + handle.resolveName(topic)};
  subscribe_full_ = [this, handle, topic]() mutable { subscribeState(handle, topic, 10); };
  const boost::function<void(const CrowdView&)> callback = [this](const CrowdView& message) {
    apply(message);
  };
  has_view_ = true;
  subscribers_.push_back(handle.subscribe<CrowdView>(topic + "/view", 10, callback));
  subscribe_full_();
  subscribeMotions(handle, topic);
}

void SubscribedCrowd::subscribeMotions(ros::NodeHandle handle, const std::string& topic) {
  const boost::function<void(const CrowdMotions&)> callback = [this](const CrowdMotions& message) {
    apply(message);
  };
  motions_subscriber_ = handle.subscribe<CrowdMotions>(topic + "/motions", 2, callback);
}

// The publisher of the rounded people may appear after that of the others, or end before it.
void SubscribedCrowd::selectTopic() {
  if (!has_view_) return;
  const bool rounded = subscribers_.front().getNumPublishers() > 0;
  if (rounded && subscribers_.size() > 1)
    subscribers_.pop_back();
  else if (!rounded && subscribers_.size() == 1)
    subscribe_full_();
}

bool SubscribedCrowd::accepts(const AgentStates& message) {
  return receive("agents", status_, [&] {
    requireSoon(message.header.stamp);
    requireFrame(message.header.frame_id);
    check(message.agents);
    return status_;
  });
}

void SubscribedCrowd::apply(const AgentStates& message) {
  receive("agents", status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    replace(peopleOf(message.agents), message.header);
    return {true, std::to_string(people_.size()) + " people"};
  });
}

void SubscribedCrowd::apply(const CrowdView& message) {
  receive("agents/view", status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    replace(fromMsg(message), message.header);
    return {true, std::to_string(people_.size()) + " people"};
  });
}

void SubscribedCrowd::apply(const CrowdMotions& message) {
  receive("agents/motions", motions_status_, [&]() -> InputStatus {
    requireFrame(message.header.frame_id);
    motions_ = fromMsg(message);
    if (changes_ > 0) ++changes_;
    return {true, std::to_string(motions_.size()) + " styles"};
  });
}

void SubscribedCrowd::replace(std::vector<Person> people, const std_msgs::Header& header) {
  people_ = std::move(people);
  stamp_ = fromMsg(header.stamp);
  frame_ = header.frame_id;
  ++changes_;
}

void SubscribedCrowd::forgetLater(Nanoseconds now) {
  forgetDelayed(now);
  changed_ = std::min(changed_, now);
  if (changes_ > 0 && stamp_ > now) clear("Waiting for a message: time went back");
}

bool SubscribedCrowd::isPublished() const {
  return std::any_of(subscribers_.begin(), subscribers_.end(),
                     [](const ros::Subscriber& one) { return one.getNumPublishers() > 0; });
}

void SubscribedCrowd::forgetSilent(Nanoseconds now) {
  if (!people_.empty() && now - stamp_ > SILENCE) clear("Waiting: no message for 3 s");
}

void SubscribedCrowd::forgetUnchanged(Nanoseconds now) {
  if (changes_ != seen_changes_) {
    seen_changes_ = changes_;
    changed_ = now;
  } else if (!people_.empty() && now - changed_ > SILENCE) {
    clear("Waiting: no message for 3 s");
  }
}

void SubscribedCrowd::clear(const char* why) {
  people_.clear();
  stamp_ = 0;
  ++changes_;
  status_ = {false, why};
}

}  // namespace vegetation_sim
