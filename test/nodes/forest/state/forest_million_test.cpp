// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Compares a forest of a million trees with a node without trees.
#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <vegetation_sim/WindField.h>
#include <visualization_msgs/MarkerArray.h>

#include <fstream>

#include "nodes/rigs/forest_rig.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"
#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim {
namespace {

constexpr std::uint32_t TREES = 1000000;
constexpr double MOST_LAYOUT_BYTES = 1e6, MOST_BYTES_PER_TREE = 200.0;
constexpr std::uint32_t MOST_STATE_BYTES = 100000;  // limit for one message

/// Calls the XML-RPC method of the master or a node with the caller's name and `argument`.
XmlRpc::XmlRpcValue ask(const std::string& host, int port, const char* method,
                        const std::string& argument) {
  XmlRpc::XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  if (!argument.empty()) request[1] = argument;
  XmlRpc::XmlRpcClient client(host.c_str(), port, "/");
  if (!client.execute(method, request, answer) || answer.size() != 3)
    throw std::runtime_error(std::string(method) + " got no answer");
  return answer[2];
}

/// Returns the resident memory of a node's process [B].
double memoryOf(const std::string& node) {
  const std::string uri =
      ask(ros::master::getHost(), static_cast<int>(ros::master::getPort()), "lookupNode", node);
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) throw std::runtime_error("no URI: " + uri);
  const int process = ask(host, static_cast<int>(port), "getPid", "");
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  std::string word;
  double kilobytes = 0.0;
  while (status >> word)
    if (word == "VmRSS:") status >> kilobytes;
  return 1024.0 * kilobytes;
}

class ForestMillion : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    forest_ = new ClockedForest(30000);
    ros::NodeHandle handle;
    wind_ = new ros::Publisher(handle.advertise<WindField>("wind", 1, true));
    sensor_ = new ros::Publisher(handle.advertise<SensorInterest>("forest/sensors", 10));
    const wind::Field field({forest::makeBreeze(1, Vec3(4, 1, 0)),
                             forest::makeDisk(2, Vec3(100, 0, 0), 60.0, Vec3(5, 0, 0))});
    wind_->publish(toMsg(field, "map", 0));
    for (const ros::Publisher* topic : {wind_, sensor_})
      spinUntil(topic->getTopic(), [&] { return topic->getNumSubscribers() > 0; });
    forest_->runUntil("the wind", [&] {
      return !forest_->state.messages.empty() &&
             forest_->state.messages.back().wind_hash == field.hash();
    });
  }
  static void TearDownTestSuite() {
    delete sensor_;
    delete wind_;
    delete forest_;
  }

  /// Moves a sensor eastwards through the trees by one step per second.
  static void walk(int seconds) {
    for (int i = 0; i < seconds; ++i) {
      SensorInterest message;
      message.id = "lidar";
      message.position.x = i;
      message.position.z = 2.0;
      message.range = 50.0;
      message.tolerance = 0.02;
      sensor_->publish(message);
      forest_->settle();
      forest_->run(30);
    }
  }

  static double bytesPerTree() {
    return (memoryOf("/forest_animator") - memoryOf("/no_trees/no_trees")) / TREES;
  }

  static ClockedForest* forest_;
  static ros::Publisher *wind_, *sensor_;
};
ClockedForest* ForestMillion::forest_ = nullptr;
ros::Publisher* ForestMillion::wind_ = nullptr;
ros::Publisher* ForestMillion::sensor_ = nullptr;

// The latched layout has the rules of tiles instead of trees, so it has kilobytes.
TEST_F(ForestMillion, LayoutIsSmall) {
  const std::uint32_t size = ros::serialization::serializationLength(forest_->layout.last());
  printf("layout of a million trees: %.1f kB\n", size / 1e3);
  EXPECT_LT(size, MOST_LAYOUT_BYTES);
  EXPECT_EQ(fromMsg(forest_->layout.last()).treeCount(), TREES);
}

// State is published at its rate while a sensor appears, moves and leaves. No message is large and
// memory does not grow.
TEST_F(ForestMillion, StateKeepsItsRateAndTreesTakeNoMemory) {  // S1-04, S1-05, N8
  const double before = bytesPerTree();
  const std::size_t first = forest_->state.messages.size();
  walk(5);
  forest_->run(150);
  const double after = bytesPerTree();
  std::uint32_t largest = 0;
  std::size_t most_listed = 0;
  for (std::size_t i = first; i < forest_->state.messages.size(); ++i) {
    const ForestState& message = forest_->state.messages[i];
    EXPECT_EQ(message.sequence, forest_->state.messages[first].sequence + i - first);
    EXPECT_EQ(fromMsg(message.header.stamp),
              forest_->grid().timeOf(forest_->grid().tickAt(fromMsg(message.header.stamp))));
    largest = std::max(largest, ros::serialization::serializationLength(message));
    most_listed = std::max(most_listed, message.trees.size());
  }
  EXPECT_EQ(forest_->state.messages.size() - first, 300u);
  EXPECT_GT(most_listed, 10u);
  EXPECT_LT(largest, MOST_STATE_BYTES);
  printf("a million trees: %.2f bytes each at rest, %.2f after a visit; largest state %.1f kB\n",
         before, after, largest / 1e3);
  EXPECT_LT(before, MOST_BYTES_PER_TREE);
  EXPECT_LT(after, MOST_BYTES_PER_TREE);
}

// S1-04, S1-06: any tree grows from its seed to the same bits in both processes.
TEST_F(ForestMillion, TreesGrowToTheSameBits) {
  const forest::Layout layout = fromMsg(forest_->layout.last());
  std::uint64_t last = 0;
  for (const std::uint32_t id : {0u, 1u, 499999u, 765432u, TREES - 1}) {
    const GetTree::Response published = forest_->ask(id);
    ASSERT_TRUE(published.success) << published.message;
    const std::uint64_t hash = forest::growTree(layout, id, {}).skeleton.hash();
    EXPECT_EQ(published.skeleton_hash, hash);
    EXPECT_NE(hash, last);
    last = hash;
  }
  EXPECT_FALSE(forest_->ask(TREES).success);
}

// Stock markers draw only the nearest trees and do not delay the state.
TEST_F(ForestMillion, MarkersStayWithinTheirBudget) {
  LatestMessage<visualization_msgs::MarkerArray> markers("forest/markers");
  markers.waitForPublisher();
  const std::uint32_t first = forest_->state.last().sequence;
  int steps = 0;
  while (markers.messages.size() < 3 && ++steps < 60) walk(1);
  ASSERT_GE(markers.messages.size(), 3u);
  EXPECT_EQ(forest_->state.last().sequence, first + 30 * static_cast<std::uint32_t>(steps));
  std::size_t points = 0;
  for (const auto& marker : markers.last().markers) points += marker.points.size();
  EXPECT_LE(points, 60000u);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_million_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
