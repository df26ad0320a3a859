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

bool isSound(const crowd::Robot& robot) {
  Faults faults;
  check(robot, faults);
  return faults.empty();
}

}  // namespace

CrowdRobots::CrowdRobots(std::string frame_id, std::vector<crowd::Robot> robots,
                         const tf2_ros::Buffer& buffer)
    : frame_id_(std::move(frame_id)), buffer_(buffer) {
  for (crowd::Robot& robot : robots) followed_.push_back({std::move(robot)});
}

void CrowdRobots::clear() {
  for (Followed& followed : followed_) followed.known = false;
  missing_.clear();
}

bool CrowdRobots::sample(Followed& followed, Nanoseconds now, bool& moved) const {
  crowd::Robot robot = followed.robot;
  Nanoseconds stamp = 0;
  try {
    const auto found = buffer_.lookupTransform(frame_id_, robot.id, ros::Time(0));
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
