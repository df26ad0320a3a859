// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/crowd/crowd_robots.h"

#include <tf2/exceptions.h>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/geometry_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

constexpr double FASTEST = 50.0;  // beyond, it is a jump [m/s]
constexpr std::size_t MOST_NAMES = 4096, LONGEST_NAME = 4096, SAMPLE_BYTES = 52;

bool isSound(const crowd::Robot& robot) {
  Faults faults;
  check(robot, faults);
  return faults.empty();
}

}  // namespace

CrowdRobots::CrowdRobots(std::string frame_id, std::vector<crowd::Robot> robots,
                         const tf2_ros::Buffer& buffer, double wait)
    : frame_id_(std::move(frame_id)), lookup_(buffer, frame_id_, wait) {
  for (crowd::Robot& robot : robots) followed_.push_back({std::move(robot)});
}

void CrowdRobots::clear() {
  for (Followed& followed : followed_) followed.known = false;
  missing_.clear();
}

CrowdRobots::Seen CrowdRobots::seen() const {
  Seen out;
  for (const Followed& followed : followed_) {
    const crowd::Robot& robot = followed.robot;
    if (followed.known) out[robot.id] = {followed.stamp, robot.position, robot.velocity, robot.yaw};
  }
  return out;
}

void CrowdRobots::restore(const Seen& seen) {
  clear();
  for (Followed& followed : followed_) {
    const auto found = seen.find(followed.robot.id);
    if (found == seen.end()) continue;
    followed.known = true;
    followed.stamp = found->second.stamp;
    followed.robot.position = found->second.position;
    followed.robot.velocity = found->second.velocity;
    followed.robot.yaw = found->second.yaw;
  }
}

void CrowdRobots::archive(Archive& a, Seen& seen) {
  a.map(
      "robots seen", seen, MOST_NAMES, SAMPLE_BYTES,
      [&a](std::string& frame) { a.text("robot frame", frame, LONGEST_NAME); },
      [&a](const std::string&, Sample& sample) {
        a.stamp("robot stamp", sample.stamp);
        for (crowd::Point* point : {&sample.position, &sample.velocity}) {
          a.number("robot x", point->x);
          a.number("robot y", point->y);
        }
        a.number("robot yaw", sample.yaw);
      });
}

bool CrowdRobots::sample(Followed& followed, Nanoseconds now, bool& moved) {
  crowd::Robot robot = followed.robot;
  Nanoseconds stamp = 0;
  try {
    const auto found = lookup_.find(robot.id);
    const Pose pose = fromMsg(found.transform);
    const Vec3 front = axisX(pose.orientation);
    robot.position = {pose.position.x(), pose.position.y()};
    robot.yaw = arcTangent(front.y(), front.x());
    stamp = fromMsg(found.header.stamp);
  } catch (const tf2::TransformException&) {
    return false;
  }
  if (stamp == 0) stamp = now;  // a chain of static transforms
  if (secondsBetween(stamp, now) > STALE || !isSound(robot)) return false;
  moved = !followed.known || stamp > followed.stamp;
  if (!moved) return true;
  const double passed = followed.known ? secondsBetween(followed.stamp, stamp) : 0.0;
  robot.velocity = {};
  if (passed > 0.0) {
    robot.velocity = (1.0 / passed) * (robot.position - followed.robot.position);
    if (!(length(robot.velocity) < FASTEST)) robot.velocity = {};
  }
  followed = {robot, stamp, true};
  return true;
}

std::vector<CrowdRobots::Change> CrowdRobots::update(Nanoseconds now) {
  std::vector<Change> out;
  missing_.clear();
  lookup_.begin(now);
  for (Followed& followed : followed_) {
    const bool was_known = followed.known;
    bool moved = false;
    if (sample(followed, now, moved)) {
      if (moved) out.push_back({false, followed.robot});
      continue;
    }
    followed.known = false;
    missing_.add(describeMissingTransform(followed.robot.id, frame_id_));
    if (was_known) out.push_back({true, followed.robot});
  }
  return out;
}

}  // namespace vegetation_sim
