// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/landscape/landscape_replica.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <functional>

#include "ros/conversions/crowd_conversions.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim {
namespace {

constexpr double ABOVE = 2.0, RADIUS = 5.0;  // [m]

// A ray from above on the middle of the left forearm of a person who holds the arms to the front.
scan::Ray onTheArm(const crowd::Walker& person) {
  const crowd::Skeleton body =
      crowd::skeletonOf(person, *crowd::flatGround(), crowd::armsToTheFront(), 0.0);
  const crowd::Limb& arm = crowd::limbOf(body, crowd::Part::FOREARM);
  return {0.5 * (arm.from + arm.to) + Vec3(0.0, 0.0, ABOVE), -Vec3::UnitZ()};
}

/// A landscape with one person who stands at the origin.
class StandingPerson : public testing::Test {
 protected:
  StandingPerson()
      : replica_(ReplicaOptions()), agents_(handle_.advertise<AgentStates>("agents", 10)) {
    replica_.subscribe(handle_);
  }

  /// Returns what the ray meets now.
  scan::Label met() {
    const ros::Time now = ros::Time::now();
    AgentStates message;
    message.header.stamp = now;
    message.header.frame_id = "map";
    message.agents.push_back(toMsg(person_, *crowd::flatGround()));
    agents_.publish(message);
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
    replica_.advance(fromMsg(now));
    replica_.update(Vec3::Zero(), RADIUS, fromMsg(now), scene_, threads_);
    return scan::cast(scene_, onTheArm(person_), 2.0 * ABOVE).label;
  }
  /// Returns whether `done` holds within a minute.
  bool until(const std::function<bool()>& done) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(60.0);
    while (!done())
      if (ros::WallTime::now() > end) return false;
    return true;
  }

  ros::NodeHandle handle_;
  LandscapeReplica replica_;
  ros::Publisher agents_;
  crowd::Walker person_;
  scan::Scene scene_;
  ThreadPool threads_;
};

// S2-35: sensors meet the arms where the styles of the node put them.
TEST_F(StandingPerson, HoldsTheArmsAsTheStylesSay) {
  ASSERT_TRUE(until([&] { return met() == scan::Label::GROUND && replica_.people() == 1; }));
  const ros::Publisher styles = handle_.advertise<CrowdMotions>("agents/motions", 1, true);
  styles.publish(toMsg(crowd::armsToTheFront()));
  EXPECT_TRUE(until([&] { return met() == scan::Label::PERSON; }));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "landscape_replica_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
