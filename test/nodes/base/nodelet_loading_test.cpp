// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// All nodes as nodelets of one manager, which runs their callbacks in eight threads. They are
// loaded and unloaded in turn while time passes and messages and requests arrive. The environment
// variable VEGETATION_SIM_NODELET_ROUNDS says how often each one is unloaded.
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/Trigger.h>
#include <vegetation_sim/TreadEvent.h>
#include <vegetation_sim/Viewer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "nodes/rigs/repeating.h"

namespace vegetation_sim {
namespace {

constexpr double TICK = 1.0 / 30.0;  // [s]
constexpr std::array<const char*, 7> NODES{
    "wind_broadcaster", "forest_animator",    "grass_field",      "canopy_animator",
    "agent_crowd",      "vegetation_scanner", "vegetation_camera"};

int roundsOf(const char* text) {
  return text ? std::max(1, std::atoi(text)) : 2;
}

/// A manager with all nodes.
class Manager {
 public:
  Manager() : loader_(ros::NodeHandle("/manager")) {
    for (const char* name : NODES) load(name);
  }
  void load(const std::string& name) {
    ASSERT_TRUE(loader_.load("/" + name, "vegetation_sim/" + name, {}, {})) << name;
  }
  void unload(const std::string& name) { ASSERT_TRUE(loader_.unload("/" + name)) << name; }

 private:
  nodelet::Loader loader_;
};

/// Publishes time, treads and viewers, four ticks in each tick of wall time.
class World {
 public:
  World()
      : clock_(handle_.advertise<rosgraph_msgs::Clock>("/clock", 10)),
        treads_(handle_.advertise<TreadEvent>("/tread", 10)),
        viewers_(handle_.advertise<Viewer>("/viewer", 10)) {}
  void step() {
    time_ += ros::Duration(TICK);
    rosgraph_msgs::Clock clock;
    clock.clock = time_;
    clock_.publish(clock);
    TreadEvent tread;
    tread.header.frame_id = "map";
    tread.header.stamp = time_;
    tread.source = "walker";
    tread.action = TreadEvent::MOVE;
    tread.position.x = std::sin(time_.toSec());
    treads_.publish(tread);
    Viewer viewer;
    viewer.header.frame_id = "map";
    viewer.header.stamp = time_;
    viewer.id = "camera";
    viewer.pose.orientation.w = 1.0;
    viewer.field_of_view = 1.0;
    viewer.height = 600;
    viewers_.publish(viewer);
    ros::WallDuration(TICK / 4.0).sleep();
  }

 private:
  ros::NodeHandle handle_;
  ros::Publisher clock_, treads_, viewers_;
  ros::Time time_{100.0};
};

/// Whether a node answers a request within ten seconds.
bool answers(const std::string& name) {
  std_srvs::Trigger request;
  return ros::service::waitForService("/" + name + "/reset", 10000) &&
         ros::service::call("/" + name + "/reset", request) && request.response.success;
}

TEST(Nodelets, AreUnloadedWhileInputsArrive) {
  World world;
  const Repeating time([&] { world.step(); });
  Manager manager;
  {
    const Repeating requests([] {
      for (const char* name : NODES) {
        std_srvs::Trigger request;
        ros::service::call(std::string("/") + name + "/reset", request);
      }
    });
    const int rounds = roundsOf(std::getenv("VEGETATION_SIM_NODELET_ROUNDS"));
    for (int round = 0; round < rounds; ++round)
      for (const char* name : NODES) {
        manager.unload(name);
        manager.load(name);
      }
  }
  for (const char* name : NODES) EXPECT_TRUE(answers(name)) << name;
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "nodelet_loading_test");
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
