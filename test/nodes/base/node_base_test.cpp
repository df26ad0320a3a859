// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// A node may be destroyed at any time while another thread runs its callbacks, as a nodelet that is
// unloaded. The launch file sets MALLOC_PERTURB_, so that memory that is freed does not look valid.
#include "nodes/base/node_base.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>

#include <atomic>
#include <string>
#include <thread>

#include "nodes/canopy/canopy_animator.h"
#include "nodes/crowd/agent_crowd.h"
#include "nodes/forest/forest_animator.h"
#include "nodes/grass/grass_field.h"
#include "nodes/sensors/vegetation_scanner.h"
#include "nodes/wind/wind_broadcaster.h"

namespace vegetation_sim {
namespace {

constexpr int LIVES = 15, CALLS = 6;  // of a node that are answered before it ends
constexpr double DEADLINE = 60.0;     // [s] of wall time; only a test that fails waits that long

/// Repeats a task in a thread of its own until it is destroyed.
class Repeating {
 public:
  template <class Task>
  explicit Repeating(Task task)
      : thread_([this, task] {
          while (!stop_) task();
        }) {}
  ~Repeating() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// Creates and destroys nodes while clients call their services and a thread runs their callbacks.
class NodeEnd : public testing::Test {
 protected:
  template <class Node>
  void liveAndEnd(const std::string& name, const std::string& scenario) {
    if (!scenario.empty())
      ros::param::set("/" + name + "/scenario", "package://vegetation_sim/test/nodes/" + scenario);
    ros::NodeHandle handle, private_handle("/" + name);
    handle.setCallbackQueue(&queue_);
    private_handle.setCallbackQueue(&queue_);
    std::atomic<int> answered{0};
    const Repeating spinner([this] { queue_.callAvailable(ros::WallDuration(0.001)); });
    const Repeating resets([&] {
      std_srvs::Trigger request;
      answered += ros::service::call("/" + name + "/reset", request);
    });
    const Repeating tuning([&] {
      dynamic_reconfigure::Reconfigure request;
      ros::service::call("/" + name + "/set_parameters", request);
    });
    for (int life = 0; life < LIVES; ++life) {
      const int before = answered;
      const Node node(handle, private_handle);
      const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(DEADLINE);
      while (answered < before + CALLS) {
        ASSERT_LT(ros::WallTime::now().toSec(), end.toSec()) << name << " does not answer";
        std::this_thread::yield();
      }
    }
  }

  ros::CallbackQueue queue_;
};

TEST_F(NodeEnd, WindBroadcasterMayEndWithinACallback) {
  liveAndEnd<WindBroadcaster>("wind_broadcaster", "wind/wind_scene.yaml");
}

TEST_F(NodeEnd, VegetationScannerMayEndWithinACallback) {
  liveAndEnd<VegetationScanner>("vegetation_scanner", "");
}

TEST_F(NodeEnd, ForestAnimatorMayEndWithinACallback) {
  liveAndEnd<ForestAnimator>("forest_animator", "scenarios/one_branch.yaml");
}

TEST_F(NodeEnd, GrassFieldMayEndWithinACallback) {
  liveAndEnd<GrassField>("grass_field", "scenarios/lawn.yaml");
}

TEST_F(NodeEnd, CanopyAnimatorMayEndWithinACallback) {
  liveAndEnd<CanopyAnimator>("canopy_animator", "scenarios/shrubs.yaml");
}

TEST_F(NodeEnd, AgentCrowdMayEndWithinACallback) {
  liveAndEnd<AgentCrowd>("agent_crowd", "scenarios/crowd.yaml");
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_base_test");
  ros::start();
  return RUN_ALL_TESTS();
}
