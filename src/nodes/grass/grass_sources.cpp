// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/grass_sources.h"

#include <utility>

#include "nodes/cutters/followed_place.h"
#include "ros/conversions/orientation.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/grass_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr unsigned ODOMETRY_QUEUE = 10;
constexpr double MOVED = 1e-6;  // [m]
constexpr std::size_t LONGEST_NAME = 4096, TREAD_BYTES = 36;

// Returns what is wrong with the orientation, or an empty text.
std::string faultOf(const nav_msgs::Odometry& message) {
  Faults faults;
  orientationOf(message.pose.pose.orientation, "pose.orientation", faults);
  return faults.empty() ? std::string() : faults.list().front();
}

}  // namespace

GrassSources::GrassSources(ros::NodeHandle handle, std::string frame_id,
                           std::vector<FollowedSource> sources, const tf2_ros::Buffer& buffer,
                           double wait)
    : frame_id_(std::move(frame_id)), buffer_(buffer), lookup_(buffer, frame_id_, wait) {
  for (FollowedSource& source : sources) followed_.push_back({std::move(source), {}, {}, 0});
  for (Followed& followed : followed_) {
    if (followed.source.odometry.empty()) continue;
    const boost::function<void(const nav_msgs::Odometry&)> heard =
        [&followed](const nav_msgs::Odometry& message) {
          followed.odometry = message;
          if (const std::string fault = faultOf(message); !fault.empty()) followed.fault = fault;
        };
    subscribers_.push_back(
        handle.subscribe<nav_msgs::Odometry>(followed.source.odometry, ODOMETRY_QUEUE, heard));
  }
}

void GrassSources::clear() {
  for (Followed& followed : followed_) {
    followed.odometry.reset();
    followed.published.reset();
    followed.published_stamp = 0;
  }
  missing_.clear();
}

GrassSources::Published GrassSources::published() const {
  Published out;
  for (const Followed& followed : followed_)
    if (followed.published)
      out[followed.source.name] = {*followed.published, followed.published_stamp};
  return out;
}

void GrassSources::restore(const Published& published) {
  for (Followed& followed : followed_) {
    followed.published.reset();
    const auto found = published.find(followed.source.name);
    if (found == published.end()) continue;
    followed.published = found->second.position;
    followed.published_stamp = found->second.stamp;
  }
}

void GrassSources::archive(Archive& a, Published& published) {
  a.map(
      "followed sources", published, MOST_FOLLOWED, TREAD_BYTES,
      [&a](std::string& name) { a.text("followed source", name, LONGEST_NAME); },
      [&a](const std::string&, LastTread& last) {
        a.vector("position of a source", last.position);
        a.stamp("stamp of a source", last.stamp);
      });
}

GrassSources::ObservedSource GrassSources::observe(const nav_msgs::Odometry& message,
                                                   const Pose& to_world, const Vec3& offset,
                                                   Nanoseconds now) {
  Faults faults;
  Pose base{fromMsg(message.pose.pose.position),
            orientationOf(message.pose.pose.orientation, "pose.orientation", faults)};
  faults.throwIfAny();
  base = compose(to_world, base);
  // The twist is in the child frame; the velocity is that of the offset point.
  const Vec3 spin = fromMsg(message.twist.twist.angular);
  const Vec3 velocity = fromMsg(message.twist.twist.linear) + cross(spin, offset);
  const Nanoseconds stamp = fromMsg(message.header.stamp);
  return {stamp == 0 ? now : stamp, transformed(base, offset), rotate(base.orientation, velocity)};
}

GrassSources::ObservedSource GrassSources::findOdometry(const Followed& followed, Nanoseconds now) {
  if (!followed.odometry) throw tf2::LookupException("nothing heard");
  const std::string& frame = followed.odometry->header.frame_id;
  Pose to_world;
  if (frame != frame_id_) to_world = fromMsg(lookup_.find(frame).transform);
  return observe(*followed.odometry, to_world, followed.source.offset, now);
}

GrassSources::ObservedSource GrassSources::find(const Followed& followed, Nanoseconds now) {
  if (!followed.source.odometry.empty()) return findOdometry(followed, now);
  const auto found = lookup_.find(followed.source.frame);
  // A chain of static transforms has no stamp; the current time stands for it.
  const Nanoseconds stamp = fromMsg(found.header.stamp);
  return {stamp == 0 ? now : stamp, transformed(fromMsg(found.transform), followed.source.offset),
          std::nullopt};
}

std::string GrassSources::describeMissing(const Followed& followed) const {
  if (!followed.source.frame.empty())
    return describeMissingTransform(followed.source.frame, frame_id_);
  const std::string& topic = followed.source.odometry;
  if (!followed.odometry) return "no odometry on " + inQuotes(topic);
  const std::string& frame = followed.odometry->header.frame_id;
  if (frame == frame_id_ || buffer_.canTransform(frame_id_, frame, ros::Time(0)))
    return "no recent odometry on " + inQuotes(topic);
  return describeMissingTransform(frame, frame_id_);
}

void GrassSources::say(const Followed& followed, grass::TreadAction action,
                       const ObservedSource& heard, std::vector<grass::TreadInput>& out) const {
  grass::TreadInput input;
  input.source = followed.source.name;
  input.action = action;
  input.position = heard.position;
  input.velocity = heard.velocity;
  Faults faults;  // none: the law was checked at the start
  input.law = fromMsg(followed.source.law, own_, "", faults);
  input.height_gate = followed.source.height_gate.value_or(height_gate_);
  input.body_frame =
      followed.source.frame.empty() ? followed.odometry->child_frame_id : followed.source.frame;
  out.push_back(std::move(input));
}

std::vector<grass::TreadInput> GrassSources::update(Nanoseconds now, const grass::TreadLaw& own,
                                                    double height_gate, const Report& report) {
  std::vector<grass::TreadInput> out;
  own_ = own;
  height_gate_ = height_gate;
  missing_.clear();
  lookup_.begin(now);
  for (Followed& followed : followed_) {
    ObservedSource heard;
    bool known = true;
    try {
      heard = find(followed, now);
      known = secondsBetween(heard.stamp, now) <= STALE;
    } catch (const tf2::TransformException&) {
      known = false;
    } catch (const InvalidInput& error) {
      known = false;
      followed.fault = error.what();
    }
    if (!followed.fault.empty()) report("source " + inQuotes(followed.source.name), followed.fault);
    followed.fault.clear();
    if (!known) {
      missing_.add(describeMissing(followed));
      if (followed.published) say(followed, grass::TreadAction::LIFT, heard, out);
      followed.published.reset();
      continue;
    }
    const bool moved =
        !followed.published || !(length(heard.position - *followed.published) <= MOVED);
    if (!moved && secondsBetween(followed.published_stamp, now) < REMINDER) continue;
    say(followed, grass::TreadAction::MOVE, heard, out);
    followed.published = heard.position;
    followed.published_stamp = now;
  }
  return out;
}

}  // namespace vegetation_sim
