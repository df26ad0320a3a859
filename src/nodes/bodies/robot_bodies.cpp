// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/bodies/robot_bodies.h"

#include <algorithm>

#include "forest/contact/contact_body.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t LONGEST_NAME = 4096, SAMPLE_BYTES = 116;

bool isSame(const Pose& a, const Pose& b) {
  const Quat &p = a.orientation, &q = b.orientation;
  return a.position == b.position && p.w == q.w && p.x == q.x && p.y == q.y && p.z == q.z;
}

bool isSound(const forest::Body& body) {
  Faults faults;
  check(body, faults);
  return faults.empty();
}

}  // namespace

RobotBodies::RobotBodies(const ros::NodeHandle& nh, std::string frame_id,
                         std::vector<forest::Body> parts, double wait)
    : frame_id_(std::move(frame_id)), lookup_(buffer_, frame_id_, wait) {
  for (forest::Body& part : parts) followed_.push_back({std::move(part), {}});
  if (!followed_.empty()) listener_ = std::make_unique<FrameListener>(buffer_, nh);
}

void RobotBodies::clear() {
  for (Followed& followed : followed_) followed.last.reset();
  missing_.clear();
  buffer_.clear();
}

RobotBodies::Seen RobotBodies::seen() const {
  Seen out;
  for (const Followed& followed : followed_)
    if (const auto& last = followed.last)
      out[followed.part.id] = {last->stamp, last->pose, last->velocity, last->spin};
  return out;
}

void RobotBodies::restore(const Seen& seen) {
  for (Followed& followed : followed_) {
    followed.last.reset();
    const auto found = seen.find(followed.part.id);
    if (found == seen.end()) continue;
    followed.last = followed.part;
    followed.last->stamp = found->second.stamp;
    followed.last->pose = found->second.pose;
    followed.last->velocity = found->second.velocity;
    followed.last->spin = found->second.spin;
  }
}

void RobotBodies::archive(Archive& a, Seen& seen) {
  a.map(
      "bodies seen", seen, MOST_PARTS, SAMPLE_BYTES,
      [&a](std::string& id) { a.text("body seen", id, LONGEST_NAME); },
      [&a](const std::string&, Sample& sample) {
        a.stamp("stamp of a body", sample.stamp);
        a.pose("pose of a body", sample.pose);
        a.vector("velocity of a body", sample.velocity);
        a.vector("spin of a body", sample.spin);
      });
}

bool RobotBodies::sample(Followed& followed, Nanoseconds now) {
  forest::Body body = followed.part;
  try {
    const auto found = lookup_.find(body.frame);
    body.pose = compose(fromMsg(found.transform), body.in_frame);
    // A chain of static transforms has no stamp: the pose is reported once, for the current time.
    const Nanoseconds stamp = fromMsg(found.header.stamp);
    if (stamp == 0 && followed.last && isSame(followed.last->pose, body.pose)) return true;
    body.stamp = stamp == 0 ? now : stamp;
  } catch (const tf2::TransformException&) {
    return false;
  }
  if (secondsBetween(body.stamp, now) > STALE_BODY || !isSound(body)) return false;
  if (followed.last) {
    const double passed = secondsBetween(followed.last->stamp, body.stamp);
    if (passed <= 0.0) return true;  // without a new transform the motion continues
    if (passed < STALE_BODY) setMotion(body, followed.last->pose, body.pose, passed);
    // A speed beyond any robot is a jump.
    if (!isSound(body)) body.velocity = body.spin = Vec3::Zero();
  }
  followed.last = body;
  return true;
}

std::vector<forest::Body> RobotBodies::update(Nanoseconds now) {
  std::vector<forest::Body> out;
  missing_.clear();
  lookup_.begin(now);
  for (Followed& followed : followed_) {
    if (sample(followed, now)) {
      out.push_back(*followed.last);
      continue;
    }
    followed.last.reset();
    missing_.add(describeMissingTransform(followed.part.frame, frame_id_));
  }
  return out;
}

std::vector<BodyChange> RobotBodies::changes(const forest::Bodies& known, Nanoseconds now) {
  const std::vector<forest::Body> present = update(now);
  std::vector<BodyChange> out;
  for (const Followed& followed : followed_) {
    const std::string& id = followed.part.id;
    const auto body = std::find_if(present.begin(), present.end(),
                                   [&](const forest::Body& b) { return b.id == id; });
    const auto old = known.find(id);
    if (body == present.end()) {
      if (old != known.end()) out.push_back({true, old->second});
    } else if (old == known.end() || old->second.stamp != body->stamp) {
      out.push_back({false, *body});
    }
  }
  return out;
}

}  // namespace vegetation_sim
