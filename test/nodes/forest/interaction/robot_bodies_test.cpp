// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/bodies/robot_bodies.h"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/error_text.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

using forest::Body;
using forest::Shape;

const forest::Body* find(const RobotParts& parts, const std::string& id) {
  for (const forest::Body& part : parts.parts)
    if (part.id == id) return &part;
  return nullptr;
}

XmlRpc::XmlRpcValue list(double x, double y, double z) {
  XmlRpc::XmlRpcValue out;
  out[0] = x, out[1] = y, out[2] = z;
  return out;
}

class RobotBodiesTest : public testing::Test {
 protected:
  RobotBodiesTest() : handle_("~/case") {}
  ~RobotBodiesTest() override { ros::param::del(handle_.getNamespace()); }

  RobotParts read() {
    Parameters parameters(handle_);
    RobotParts out = readRobotParts(handle_, parameters);
    parameters.finish();
    return out;
  }
  void setBody(XmlRpc::XmlRpcValue body) {
    XmlRpc::XmlRpcValue bodies;
    bodies[0] = body;
    handle_.setParam("bodies", bodies);
  }

  ros::NodeHandle handle_;
};

TEST_F(RobotBodiesTest, NoParameterGivesNoBody) {
  EXPECT_TRUE(read().parts.empty());
}

TEST_F(RobotBodiesTest, ListIsRead) {
  XmlRpc::XmlRpcValue body;
  body["id"] = "boom";
  body["frame"] = "boom_link";
  body["shape"] = "capsule";
  body["radius"] = 0.05;
  body["length"] = 2;
  body["position"] = list(0.0, 0.5, 1.0);
  body["rotation"] = list(0.5 * PI, 0.0, 0.0);
  setBody(body);
  const RobotParts found = read();
  ASSERT_EQ(found.parts.size(), 1u);
  const forest::Body& part = found.parts[0];
  EXPECT_EQ(part.id, "boom");
  EXPECT_EQ(part.frame, "boom_link");
  EXPECT_EQ(part.shape, Shape::CAPSULE);
  EXPECT_EQ(part.size, Vec3(0.05, 0.0, 2.0));
  EXPECT_EQ(part.in_frame.position, Vec3(0.0, 0.5, 1.0));
  EXPECT_NEAR(length(axisZ(part.in_frame.orientation) + Vec3::UnitY()), 0.0, 1e-12);
}

TEST_F(RobotBodiesTest, FaultsOfTheListAreReported) {
  XmlRpc::XmlRpcValue body;
  body["shape"] = "cone";
  body["radius"] = -1.0;
  body["radios"] = 1.0;
  setBody(body);
  const std::string faults = errorOf([&] { read(); });
  for (const char* part : {"shape = 'cone'", "radius = -1", "radios", "frame"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

XmlRpc::XmlRpcValue robot(const std::string& description, const std::string& prefix) {
  XmlRpc::XmlRpcValue out;
  out["robot_description"] = description;
  out["prefix"] = prefix;
  return out;
}

TEST_F(RobotBodiesTest, CollisionGeometryOfAUrdfIsRead) {
  setBody(robot("robot_description", "r1/"));
  const RobotParts found = read();
  ASSERT_EQ(found.parts.size(), 4u);
  const forest::Body* base = find(found, "r1/base");
  const forest::Body* arm = find(found, "r1/arm");
  const forest::Body* hand = find(found, "r1/arm_1");
  const forest::Body* wheel = find(found, "r1/wheel");
  ASSERT_TRUE(base && arm && hand && wheel);
  EXPECT_EQ(base->shape, Shape::BOX);
  EXPECT_EQ(base->size, Vec3(0.8, 0.6, 0.4));
  EXPECT_EQ(base->in_frame.position, Vec3(0.0, 0.0, 0.2));
  EXPECT_EQ(arm->frame, "r1/arm");
  EXPECT_EQ(arm->shape, Shape::CAPSULE);
  EXPECT_NEAR(length(arm->size - Vec3(0.05, 0.0, 0.9)), 0.0, 1e-12);
  EXPECT_NEAR(length(axisZ(arm->in_frame.orientation) - Vec3::UnitX()), 0.0, 1e-12);
  EXPECT_EQ(hand->shape, Shape::SPHERE);
  EXPECT_EQ(wheel->shape, Shape::BOX);
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_EQ(found.left_out[0].find("link 'r1/camera' touches nothing: "), 0u) << found.left_out[0];
}

TEST_F(RobotBodiesTest, EqualMeshesAreReadAndCoveredOnce) {
  std::vector<std::string> names;
  const auto read = [&](const std::string& name) {
    names.push_back(name);
    return forest::Triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 2}}, {{0, 1, 2}}};
  };
  const auto link = [](const std::string& name, const std::string& mesh) {
    return "<link name='" + name + "'><collision><geometry><mesh filename='" + mesh +
           "'/></geometry></collision></link>";
  };
  const auto joint = [](const std::string& child) {
    return "<joint name='" + child + "' type='fixed'><parent link='a'/><child link='" + child +
           "'/></joint>";
  };
  Faults faults;
  const RobotParts found = partsOfUrdf(
      "<robot name='r'>" + link("a", "wheel.stl") + link("b", "wheel.stl") +
          link("c", "wheel.stl' scale='1 1 2") + link("d", "arm.stl") + link("e", "wheel.stl") +
          joint("b") + joint("c") + joint("d") + joint("e") + "</robot>",
      "", faults, read);
  EXPECT_EQ(names, (std::vector<std::string>{"wheel.stl", "wheel.stl", "arm.stl"}));
  std::map<std::string, std::vector<Vec3>> sizes;
  for (const Body& part : found.parts) sizes[part.frame].push_back(part.size);
  ASSERT_EQ(sizes.size(), 5u);
  EXPECT_EQ(sizes["a"], sizes["b"]);
  EXPECT_EQ(sizes["a"], sizes["e"]);
  EXPECT_NE(sizes["a"], sizes["c"]);
}

// A bracket in millimetres, stretched to metres by the URDF, and turned by the link's origin.
TEST_F(RobotBodiesTest, MeshOfAUrdfIsCovered) {
  const auto read = [](const std::string& name) {
    if (name != "package://robot/bracket.stl") throw InvalidInput(name + ": is not here");
    return forest::Triangles{{{0, 0, 0}, {400, 0, 0}, {400, 200, 0}, {0, 200, 100}},
                             {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
  };
  Faults faults;
  const RobotParts found = partsOfUrdf(
      "<robot name='r'><link name='bracket'><collision><origin xyz='1 0 0' rpy='0 0 1.5707963'/>"
      "<geometry><mesh filename='package://robot/bracket.stl' scale='0.001 0.001 0.001'/>"
      "</geometry></collision></link></robot>",
      "r1/", faults, read);
  ASSERT_FALSE(found.parts.empty());
  EXPECT_LE(found.parts.size(), 8u);
  EXPECT_TRUE(found.left_out.empty());
  EXPECT_GT(found.mesh_error, 0.0);
  EXPECT_LT(found.mesh_error, 0.1);
  EXPECT_EQ(found.parts[0].id, "r1/bracket");
  for (const Body& part : found.parts) {
    EXPECT_EQ(part.frame, "r1/bracket");
    EXPECT_LE(part.in_frame.position.x(), 1.0);  // y of the mesh points to -x
    EXPECT_GE(part.in_frame.position.x(), 0.8);
    EXPECT_GE(part.in_frame.position.y(), 0.0);
    EXPECT_LE(part.in_frame.position.y(), 0.4);
  }
}

TEST_F(RobotBodiesTest, TwoRobotsHaveTheirOwnLists) {
  for (const char* name : {"r1", "r2"}) {
    XmlRpc::XmlRpcValue bodies;
    bodies[0] = robot("robot_description", std::string(name) + "/");
    handle_.setParam("bodies/" + std::string(name), bodies);
  }
  const RobotParts found = read();
  EXPECT_EQ(found.parts.size(), 8u);
  EXPECT_TRUE(find(found, "r1/arm") && find(found, "r2/arm"));
}

TEST_F(RobotBodiesTest, TextsThatAreNotUrdfAreRejected) {
  setBody(robot("no_such_parameter", ""));
  EXPECT_NE(
      errorOf([&] { read(); }).find("'no_such_parameter' is not a parameter whose value is a URDF"),
      std::string::npos);
}

geometry_msgs::TransformStamped frameAt(Nanoseconds stamp, double x) {
  geometry_msgs::TransformStamped out;
  out.header.frame_id = "map";
  out.header.stamp = toStamp(stamp);
  out.child_frame_id = "hand";
  out.transform.translation.x = x;
  out.transform.rotation.w = 1.0;
  return out;
}

class Following : public testing::Test {
 protected:
  Following() : bodies_(ros::NodeHandle(), "map", {part()}) {}

  static forest::Body part() {
    forest::Body out;
    out.id = out.frame = "hand";
    out.in_frame.position = Vec3(0.0, 0.0, 1.0);
    return out;
  }
  // Sends until the body is known with that stamp. Returns an empty result if that never happens.
  std::vector<Body> follow(Nanoseconds stamp, double x, Nanoseconds now) {
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(30.0);
    while (ros::WallTime::now() < deadline) {
      broadcaster_.sendTransform(frameAt(stamp, x));
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
      const std::vector<Body> found = bodies_.update(now);
      if (!found.empty() && found[0].stamp == stamp) return found;
    }
    return {};
  }

  tf2_ros::TransformBroadcaster broadcaster_;
  RobotBodies bodies_;
};

constexpr Nanoseconds START = 100 * NANOSECONDS_PER_SECOND;
constexpr Nanoseconds TENTH = NANOSECONDS_PER_SECOND / 10;

TEST_F(Following, TwoSamplesGiveTheVelocity) {
  std::vector<Body> found = follow(START, 1.0, START);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pose.position, Vec3(1.0, 0.0, 1.0));
  EXPECT_EQ(found[0].velocity, Vec3(0.0, 0.0, 0.0));
  found = follow(START + TENTH, 1.2, START + TENTH);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].velocity.x(), 2.0, 1e-9);
  // Without a new transform the motion continues.
  found = bodies_.update(START + 2 * TENTH);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].velocity.x(), 2.0, 1e-9);
  EXPECT_TRUE(bodies_.missing().list().empty());
}

TEST_F(Following, SilentFrameRemovesTheBody) {
  ASSERT_EQ(follow(START, 1.0, START).size(), 1u);
  EXPECT_TRUE(bodies_.update(START + NANOSECONDS_PER_SECOND).empty());
  EXPECT_EQ(bodies_.missing().list(),
            std::vector<std::string>{"no transform from 'hand' to 'map'"});
}

TEST_F(Following, JumpIsNotASpeed) {
  ASSERT_EQ(follow(START, 1.0, START).size(), 1u);
  const std::vector<Body> found = follow(START + TENTH, 500.0, START + TENTH);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].velocity, Vec3(0.0, 0.0, 0.0));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "robot_bodies_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
