// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <vegetation_sim/AgentStates.h>

#include "crowd/body/gait.h"
#include "nodes/crowd/agent_crowd.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"

namespace vegetation_sim {
namespace {

constexpr double BODY_RADIUS = 0.16, FOOT_RADIUS = 0.06;  // of a tread [m]
constexpr double PUBLISH_EVERY = 0.12;                    // a body's way [m]
constexpr double FAR = 1000.0, ARM = 0.5;                 // of walkers from robots [m]
constexpr std::size_t MOST_PREDICTED = 64;                // people, in many phases of the gait

}  // namespace

std::string AgentCrowd::nameOf(const crowd::Walker& walker) const {
  return options_.frame_prefix + "walker_" + std::to_string(walker.id);
}

AgentStates AgentCrowd::agentsAt(Nanoseconds stamp) const {
  AgentStates message;
  message.header.stamp = toStamp(stamp);
  message.header.frame_id = options_.frame_id;
  message.hash = shard_ ? crowd_.snapshot().walkersHash() : crowd_.snapshot().hash();
  for (const crowd::Walker& walker : crowd_.walkers())
    message.agents.push_back(toMsg(walker, crowd_.terrain()));
  return message;
}

void AgentCrowd::publishAgents(Nanoseconds stamp) {
  if (isPart()) {
    publishPart(stamp);
    return;
  }
  if (agents_publisher_.getNumSubscribers() + near_publisher_.getNumSubscribers() == 0) return;
  const AgentStates message = agentsAt(stamp);
  publishNear(message);
  if (agents_publisher_.getNumSubscribers() == 0) return;
  state_bytes_ += ros::serialization::serializationLength(message);
  agents_publisher_.publish(message);
}

// Sensors read this, which depends on none of the viewers.
void AgentCrowd::publishNear(const AgentStates& all) {
  if (near_publisher_.getNumSubscribers() == 0) return;
  near_sensors_.update(sensors_.discsAt(fromMsg(all.header.stamp)));
  NearAgents message;
  message.header = all.header;
  message.hash = all.hash;
  message.discs = toMsg(near_sensors_.discs());
  for (const AgentState& agent : all.agents)
    if (near_sensors_.includes(agent.pose.position.x, agent.pose.position.y))
      message.agents.push_back(agent);
  near_bytes_ += ros::serialization::serializationLength(message);
  near_publisher_.publish(message);
}

// Displays read this, plants and other nodes `agents`, which does not depend on who reads it.
void AgentCrowd::publishView(Nanoseconds stamp) {
  if (isPart() || view_publisher_.getNumSubscribers() == 0) return;
  sendView(crowd_.walkers(), stamp);
}

void AgentCrowd::sendView(const std::vector<crowd::Walker>& walkers, Nanoseconds stamp) {
  near_viewers_.update(discsOf(viewers_.eyesAt(stamp), options_.view_range));
  std::vector<crowd::Walker> seen;
  for (const crowd::Walker& walker : walkers)
    if (near_viewers_.includes(walker.position.x, walker.position.y)) seen.push_back(walker);
  CrowdView message = toView(seen, crowd_.terrain());
  message.header.stamp = toStamp(stamp);
  message.header.frame_id = options_.frame_id;
  view_bytes_ += ros::serialization::serializationLength(message);
  view_publisher_.publish(message);
}

// Displays and sensors need no files.
void AgentCrowd::publishMotions() {
  CrowdMotions message = toMsg(options_.motions);
  message.header.frame_id = options_.frame_id;
  motions_publisher_.publish(message);
}

TreadEvents AgentCrowd::emptyTreads() const {
  TreadEvents out;
  out.header.frame_id = options_.frame_id;
  if (clock_.hasBegun()) out.header.stamp = toStamp(clock_.stamp());
  if (!awaitsMeadow()) return out;
  out.complete_until = ros::Time(0, 1);  // before the first tick there are none
  if (clock_.hasBegun()) out.complete_until = toStamp(stampOfTreads(clock_.tick() + 1) - 1);
  return out;
}

Nanoseconds AgentCrowd::stampOfTreads(std::int64_t tick) const {
  return clock_.grid().timeOf(tick + options_.tread_ahead);
}

void AgentCrowd::publishTreads() {
  if (options_.tread == Treading::NONE) return;
  TreadEvents treads = emptyTreads();
  const Nanoseconds stamp = stampOfTreads(clock_.tick());
  for (const crowd::Walker& walker : crowd_.walkers()) {
    if (options_.tread == Treading::BODY)
      treadOfBody(walker, stamp, treads);
    else
      treadOfFeet(walker, stamp, treads);
  }
  for (auto entry = trodden_.begin(); entry != trodden_.end();)
    entry = crowd_.find(entry->first) || (shard_ && shard_->isHanded(entry->first))
                ? std::next(entry)
                : trodden_.erase(entry);
  if (recovers()) return;  // those of ticks that run again were published
  if (treads.events.empty() && !awaitsMeadow()) return;
  treads_ += treads.events.size();
  treads_publisher_.publish(treads);
}

// The meadow joins the places of a track, so a place per PUBLISH_EVERY is enough.
void AgentCrowd::treadOfBody(const crowd::Walker& walker, Nanoseconds stamp, TreadEvents& treads) {
  Trodden& last = trodden_[walker.id];
  if (last.seen && length(walker.position - last.place) < PUBLISH_EVERY) return;
  TreadEvent event;
  event.header.stamp = toStamp(stamp);
  event.header.frame_id = options_.frame_id;
  event.source = nameOf(walker);
  event.action = last.seen ? TreadEvent::MOVE : TreadEvent::PLACE;
  const crowd::Point& p = walker.position;
  event.position = toPoint(Vec3(p.x, p.y, crowd_.terrain().height(p.x, p.y)));
  event.has_velocity = event.law.has_radius = true;
  event.velocity = toVector(Vec3(walker.velocity.x, walker.velocity.y, 0.0));
  event.law.radius = options_.tread_radius > 0.0 ? options_.tread_radius : BODY_RADIUS;
  last.place = p;
  last.seen = true;
  treads.events.push_back(std::move(event));
}

// Each foot that lands makes a stroke from heel to ball.
void AgentCrowd::treadOfFeet(const crowd::Walker& walker, Nanoseconds stamp, TreadEvents& treads) {
  Trodden& last = trodden_[walker.id];
  const SinCos front = sinCos(walker.heading);
  const double sole = crowd::Proportions::FOOT_FRONT + crowd::Proportions::FOOT_BACK;
  for (std::size_t i = 0; i < 2; ++i) {
    const crowd::Foot& foot = walker.feet[i];
    const bool lands = foot.stands && (!last.stood[i] || !last.seen);
    last.stood[i] = foot.stands;
    if (!lands) continue;
    const crowd::Point heel =
        foot.planted - (walker.height * sole) * crowd::Point{front.cos, front.sin};
    const auto onGround = [&](const crowd::Point& p) {
      return toPoint(Vec3(p.x, p.y, crowd_.terrain().height(p.x, p.y)));
    };
    TreadEvent event;
    event.header.stamp = toStamp(stamp);
    event.header.frame_id = options_.frame_id;
    event.source = nameOf(walker) + (i == 0 ? "_left" : "_right");
    event.action = TreadEvent::STROKE;
    event.start = onGround(heel);
    event.position = onGround(foot.planted);
    event.law.has_radius = true;
    event.law.radius = options_.tread_radius > 0.0 ? options_.tread_radius : FOOT_RADIUS;
    treads.events.push_back(std::move(event));
  }
  last.seen = true;
}

// Walkers nearest to a robot get frames first.
std::vector<TierChoice> AgentCrowd::chooseFrames(Nanoseconds stamp) {
  std::vector<TierChoice> out;
  if (options_.tf_budget == 0) return out;
  for (const crowd::Walker& walker : crowd_.walkers()) {
    double nearest = FAR;
    for (const auto& robot : crowd_.snapshot().robots)
      nearest = std::min(nearest, length(robot.second.position - walker.position));
    TierChoice choice;
    choice.id = walker.id;
    choice.error[0] = static_cast<float>(1.0 / (ARM + nearest));
    choice.cost[1] = 1.F;
    out.push_back(choice);
  }
  held_frames_.allocateTiers(out, 1, options_.tf_budget, 0.0, stamp);
  return out;
}

void AgentCrowd::sendFrames() {
  const Nanoseconds stamp = crowd_.snapshot().stamp;
  if (stamp == frames_stamp_) return;  // tf refuses a second frame of the same stamp
  frames_stamp_ = stamp;
  std::vector<geometry_msgs::TransformStamped> frames;
  const std::vector<TierChoice> choices = chooseFrames(stamp);
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i].chosen == 0) continue;
    const crowd::Walker& walker = crowd_.walkers()[i];
    const AgentState state = toMsg(walker, crowd_.terrain());
    geometry_msgs::TransformStamped frame;
    frame.header.stamp = toStamp(stamp);
    frame.header.frame_id = options_.frame_id;
    frame.child_frame_id = nameOf(walker);
    frame.transform.translation = toVector(fromMsg(state.pose.position));
    frame.transform.rotation = state.pose.orientation;
    frames.push_back(frame);
  }
  frames_sent_ = frames.size();
  if (!frames.empty()) tf_broadcaster_.sendTransform(frames);
}

void AgentCrowd::addDiagnostics(Status& status) {
  robots_.missing().warn(name_, status);
  warnOfMore(status, unsent_covers_, reported_unsent_,
             "times that a cover map of cover_rate did not come within frame_wait");
  reported_unsent_ = unsent_covers_;
  const std::uint64_t dropped = inbox_ ? inbox_->dropped() : 0;
  warnOfMore(status, dropped, reported_dropped_, "borders of shards dropped, too large");
  reported_dropped_ = dropped;
  std::size_t arrived = 0;
  for (const crowd::Walker& walker : crowd_.walkers()) arrived += walker.arrived;
  status.add("Walkers", crowd_.walkers().size());
  status.add("Walkers arrived", arrived);
  status.add("Walls and trunks", crowd_.obstacles().obstacles().size());
  status.add("Trunks", trunks_);
  status.add("Robots", crowd_.snapshot().robots.size());
  status.add("Robots without a transform", robots_.missing().size());
  status.add("Transforms too late for their tick", robots_.late());
  status.add("Deepest overlap [mm]", static_cast<int>(1e3 * crowd_.deepestOverlap()));
  status.add("People who wait for another shard", shard_ ? shard_->waiting().size() : 0);
  status.add("Borders of shards too late for their tick", inbox_ ? inbox_->late() : 0);
  status.add("People of shards too late for their tick", parts_ ? parts_->late() : 0);
  status.add("Cover maps awaited in vain", unsent_covers_);
  status.add("Treads sent", treads_);
  status.add("State sent [B]", state_bytes_);
  status.add("View sent [B]", view_bytes_);
  status.add("Sent to sensors [B]", near_bytes_);
  status.add("Sensors", sensors_.size());
}

// The tf frames do not affect the walkers.
void AgentCrowd::addGovernor(Status& status) {
  markers_.reportTiers(status);
  status.add("Viewers", viewers_.size());
  status.add("tf frames", frames_sent_);
  status.add("tf budget [frames]", options_.tf_budget);
}

// The error of a body takes as long as drawing it 25 times, so a large crowd has a sample.
double AgentCrowd::viewError() const {
  const std::vector<crowd::Walker>& walkers = crowd_.walkers();
  const crowd::WalkerRounding rounding = viewRounding(walkers, crowd_.terrain());
  const double seconds = secondsBetween(0, crowd_.snapshot().stamp);
  const std::size_t every = walkers.size() / MOST_PREDICTED + 1;
  double largest = 0.0;
  for (std::size_t i = 0; i < walkers.size(); i += every)
    largest = std::max(
        largest, limbErrorOf(walkers[i], crowd_.terrain(), options_.motions, seconds, rounding));
  return largest;
}

std::vector<PredictedError> AgentCrowd::predictErrors() const {
  PredictedError view;
  view.topic = "agents/view";
  view.metres = viewError();
  view.cost = view.wanted = static_cast<double>(view_bytes_);
  view.unit = "B sent";
  return {predictError("agents/markers", markers_.balance(), markers_.balanceTerms()), view};
}

}  // namespace vegetation_sim
