// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/forest_conversions.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <cmath>
#include <limits>

#include "core/error_text.h"
#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim {
namespace {

constexpr double FOREST_NAN = std::numeric_limits<double>::quiet_NaN();

/// Returns a layout with a different value in every field.
forest::Layout exampleForest() {
  forest::Layout out = forest::gridLayout(2, 10.0);
  out.motion = {forest::JointModel::PAPER, forest::Gain::PAPER, forest::Drag::QUADRATIC, 3.25,
                forest::TransitionShape::LINEAR};
  out.terrain = "package://somewhere/hills.yaml";
  out.terrain_hash = 18446744073709551615ULL;
  out.trees[1].position = Vec3(0.1, -2.2, 3.3);
  out.trees[1].scale = 1.7;
  out.tiles = {{4, 7, 99, -1.5, 2.5, 30.0, {1.f, 0.f, 2.5f, 0.1f}},
               {11, 3, 98, 28.5, 2.5, 20.0, {1.f, 1.f, 1.f, 1.f}}};
  return out;
}

TEST(ForestConversions, ReturnEveryFieldOfALayout) {  // S1-04: the message has only seeds
  const forest::Layout layout = exampleForest();
  const ForestLayout message = toMsg(layout);
  const forest::Layout back = fromMsg(message);
  EXPECT_EQ(message.hash, layout.hash());
  EXPECT_EQ(back.hash(), layout.hash());  // the hash covers every number
  EXPECT_EQ(back.terrain, layout.terrain);
  EXPECT_EQ(message.joint_model, "paper");
  EXPECT_EQ(message.gain, "paper");
  EXPECT_EQ(message.drag, "quadratic");
  EXPECT_EQ(message.transition_shape, "linear");
  EXPECT_EQ(message.species[3].name, "willow");
}

TEST(ForestConversions, TreeSeedTakesLessThanAKilobyte) {  // S1-05
  EXPECT_LT(ros::serialization::serializationLength(toMsg(exampleForest().trees[1])), 1024u);
}

TEST(ForestConversions, RefuseALayoutWithAllItsFaults) {
  ForestLayout message = toMsg(exampleForest());
  message.joint_model = "rubber";
  message.drag = "";
  message.species[2].rules = "{height: -3, hieght: 4}";
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"joint_model = 'rubber' is none of swing, paper", "drag = '' is none of linear, quadratic",
        "species birch: height = -3 m is outside 0.1 to 100 m", "hieght is not a known key"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

// A long name would be copied for each limb and fault, and a text may have any number of them.
TEST(ForestConversions, RefuseLongNamesAndRules) {
  ForestLayout message = toMsg(exampleForest());
  message.species[1].name = std::string(257, 'n');
  message.species[1].rules = "{limbs: [a, a]}";
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "layout: species " + inQuotes(message.species[1].name) +
                ": name has 257 letters, more than the 256 allowed");
  message.species[1].name = "oak";
  message.species[1].rules = "{name: " + std::string(300, 'n') + "}";
  EXPECT_NE(errorOf([&] { fromMsg(message); }).find("...: name has 300 letters, more than"),
            std::string::npos);
  message.species[1].rules = "{limbs: [a, a, a, a, a, a, a]}";
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "species oak: limbs has 7 entries, more than the 6 allowed");
  message.species[0].rules = message.species[1].rules = std::string((1 << 19) + 1, ' ');
  EXPECT_NE(
      errorOf([&] { fromMsg(message); }).find("bytes together, more than the 1048576 allowed"),
      std::string::npos);
}

TEST(ForestConversions, QuoteTheBeginningOfALongWord) {
  ForestLayout message = toMsg(exampleForest());
  message.joint_model = std::string(100000, 'j');
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "layout: joint_model = " + inQuotes(message.joint_model) + " is none of swing, paper");
}

TEST(ForestConversions, RejectAnInvalidLayout) {
  ForestLayout message = toMsg(exampleForest());
  message.trees[0].species = 9;
  message.trees[1].yaw = FOREST_NAN;
  message.tiles[1].first_tree = 12;
  message.tiles[0].mix.pop_back();
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part : {"trees[0]: species = 9 is outside 0 to 3", "trees[1]: yaw",
                           "tiles[1]: first_tree = 12 should be 11", "tiles[0]: mix has 3 weights"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
  message = toMsg(exampleForest());
  message.species.resize(300);
  EXPECT_EQ(errorOf([&] { fromMsg(message); }), "layout: 300 species, more than the 256 allowed");
}

forest::LevelState between() {
  forest::LevelState out;
  out.level = 3;
  out.since = forest::seconds(1.7e9) + 123456789;
  out.blend = {1.f, 0.3f, 0.1f, 0.f, 0.f, 0.f};
  return out;
}

void expectEqual(const forest::LevelState& a, const forest::LevelState& b) {
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.since, b.since);
  EXPECT_EQ(a.blend, b.blend);
}

TEST(ForestConversions, ReturnAStateToTheBit) {  // S1-23, N6
  forest::StateUpdate update;
  update.stamp = forest::seconds(1.7e9) + forest::seconds(1.0);
  update.sequence = 77;
  update.key_frame = false;
  update.base = between();
  update.layout_hash = 18446744073709551615ULL;
  update.wind_hash = 2;
  update.hash = 3;
  update.trees_hash = 4;
  update.shard = 2;
  update.shards = 3;
  update.trees = {{4, forest::LevelState::settled(2)}, {5000000, between()}};
  const forest::StateUpdate back = fromMsg(toMsg(update));
  EXPECT_EQ(back.stamp, update.stamp);
  EXPECT_EQ(back.sequence, 77u);
  EXPECT_FALSE(back.key_frame);
  EXPECT_EQ(back.layout_hash, update.layout_hash);
  EXPECT_EQ(back.wind_hash, 2u);
  EXPECT_EQ(back.hash, 3u);
  EXPECT_EQ(back.trees_hash, 4u);
  EXPECT_EQ(back.shard, 2u);
  EXPECT_EQ(back.shards, 3u);
  expectEqual(back.base, update.base);
  ASSERT_EQ(back.trees.size(), 2u);
  EXPECT_EQ(back.trees[1].tree, 5000000u);
  for (std::size_t i = 0; i < 2; ++i) expectEqual(back.trees[i].state, update.trees[i].state);
}

forest::PromotedBranch bent(int branch, Nanoseconds blend) {
  return {branch, {0.1, -1.0 / 3.0}, {5.0 / 7.0, -1e-9}, blend};
}

// S1-34: a physical branch takes 44 bytes of a message: four numbers, its index and the start of
// its blend.
TEST(ForestMessages, APhysicalBranchHasItsStatedBytes) {
  ForestState state;
  state.trees.resize(1);
  const std::uint32_t none = ros::serialization::serializationLength(state);
  state.trees[0].promoted.resize(58);
  EXPECT_EQ(ros::serialization::serializationLength(state) - none, 58u * 44u);
  EXPECT_EQ(44u, 4 * sizeof(double) + sizeof(std::uint32_t) + 8u);
}

// N7: the budget of changed levels counts with the size of a tree in transition.
TEST(ForestMessages, AChangedLevelHasItsStatedBytes) {
  ForestState state;
  const std::uint32_t none = ros::serialization::serializationLength(state);
  state.trees.resize(10);
  for (TreeState& tree : state.trees) tree.blend.resize(forest::LevelState().blend.size());
  EXPECT_EQ(ros::serialization::serializationLength(state) - none, 10u * 61u);
  EXPECT_EQ(forest::ENTRY_BYTES, 61.0);
}

TEST(ForestConversions, ReturnPhysicalBranchesToTheBit) {  // S1-34, S1-37
  forest::StateUpdate update;
  update.blend = 0.7;
  update.trees = {{4, forest::LevelState::settled(2), {bent(3, forest::NEVER), bent(9, 1234567)}}};
  const forest::StateUpdate back = fromMsg(toMsg(update));
  EXPECT_EQ(back.blend, 0.7);
  ASSERT_EQ(back.trees[0].promoted.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const forest::PromotedBranch &a = back.trees[0].promoted[i], &b = update.trees[0].promoted[i];
    EXPECT_EQ(a.branch, b.branch);
    EXPECT_EQ(a.q.first, b.q.first);
    EXPECT_EQ(a.q.second, b.q.second);
    EXPECT_EQ(a.rate.first, b.rate.first);
    EXPECT_EQ(a.rate.second, b.rate.second);
    EXPECT_EQ(a.blend, b.blend);
  }
}

TEST(ForestConversions, RejectInvalidPhysicalBranches) {
  forest::StateUpdate update;
  update.trees = {{4, forest::LevelState::settled(2), {bent(3, 0), bent(3, 0), bent(20000, 0)}}};
  ForestState message = toMsg(update);
  message.blend_time = -1.0;
  message.trees[0].promoted[0].first = FOREST_NAN;
  message.trees[0].promoted[1].second_rate = 1e9;
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"blend_time = -1", "tree 4: branch 3: first", "second_rate = 1e+09 is outside",
        "branch 3: branch is not above", "branch 20000: branch is not above"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

forest::BrokenBranch fallen(int branch) {
  forest::BrokenBranch out;
  out.branch = branch;
  out.stamp = 1234567;
  out.cut = true;
  out.pose = {Vec3(0.1, -1.0 / 3.0, 2.0), Quat{0.6, 0.0, 0.8, 0.0}};
  out.velocity = Vec3(0.7, 0.0, -5.0 / 7.0);
  out.spin = Vec3(-1e-9, 3.0, 0.0);
  return out;
}

TEST(ForestConversions, ReturnBrokenBranchesToTheBit) {
  forest::StateUpdate update;
  update.trees = {{4, forest::LevelState::settled(2), {}, {}, {fallen(3), fallen(9)}}};
  const forest::StateUpdate back = fromMsg(toMsg(update));
  EXPECT_TRUE(back.trees[0].broken == update.trees[0].broken);
}

TEST(ForestConversions, RejectInvalidBrokenBranches) {
  forest::StateUpdate update;
  update.trees = {{4, forest::LevelState::settled(2), {}, {}, {fallen(3), fallen(9), fallen(5)}}};
  ForestState message = toMsg(update);
  auto& broken = message.trees[0].broken;
  broken[0].branch = 0;
  broken[0].twist.linear.y = FOREST_NAN;
  broken[1].branch = 4294967295u;
  broken[1].pose.position.x = 1e9;
  broken[2].pose.orientation.w = 0.0;
  broken[2].twist.angular.z = FOREST_NAN;
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"tree 4: broken branch 0: branch = 0 is outside 1 to", "broken branch 0: velocity",
        "broken branch 4294967295: branch = -1 is outside", "position", "broken branch 5: spin",
        "broken branch 5: norm of orientation = 0.8 is outside"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
  broken.assign(4097, broken.front());
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "state: 4097 broken branches, allowed are 0 to 4096");
}

TEST(ForestConversions, RejectMoreTreesInModesThanAnAnimatorCanHave) {
  forest::StateUpdate update;
  const physics::ModalState modes{{0.0}, {0.0}};
  for (std::uint32_t id = 0; id < 1000; ++id)
    update.trees.push_back({id, forest::LevelState::settled(2), {}, modes});
  ForestState message = toMsg(update);
  EXPECT_EQ(fromMsg(message).trees.size(), 1000u);
  message.trees.push_back(message.trees.back());
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "state: 1001 trees in modes, allowed are 0 to 1000");
}

TEST(ForestConversions, SettledTreesAreSentWithoutBlends) {
  forest::StateUpdate update;
  update.base = forest::LevelState::settled(1);
  update.trees = {{4, forest::LevelState::settled(2)}, {5, between()}};
  const ForestState message = toMsg(update);
  EXPECT_TRUE(message.base_blend.empty());
  EXPECT_TRUE(message.trees[0].blend.empty());
  EXPECT_EQ(message.trees[1].blend.size(), 7u);
}

TEST(ForestConversions, RefuseAStateWithAllItsFaults) {
  forest::StateUpdate update;
  update.trees = {{4, between()}, {5, between()}, {6, between()}};
  ForestState message = toMsg(update);
  message.base_level = 9;
  message.trees[0].level = 8;
  message.trees[1].blend.pop_back();
  message.trees[2].blend[1] = 1.5f;
  message.trees[2].blend[2] = std::numeric_limits<float>::quiet_NaN();
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"state: base_level = 9 is outside 0 to 7", "state: tree 4: level = 8 is outside 0 to 7",
        "state: tree 5: blend has 6 entries, allowed are 0 or 7",
        "state: tree 6: blend = 1.5 is outside 0 to 1", "is not finite, allowed is 0 to 1"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

Viewer exampleViewer() {
  Viewer out;
  out.id = "eye";
  out.header.stamp = ros::Time(12, 5);
  out.pose.position.x = 3.0;
  out.pose.orientation.z = out.pose.orientation.w = std::sqrt(0.5);  // faces north
  out.field_of_view = 1.0;
  out.height = 800;
  return out;
}

TEST(ForestConversions, ViewerBecomesAViewpoint) {  // N8
  const forest::Viewer viewer = fromMsg(exampleViewer());
  EXPECT_EQ(viewer.id, "eye");
  EXPECT_EQ(viewer.stamp, 12000000005);
  EXPECT_EQ(viewer.eye.position.x(), 3.0);
  // The focal length is half the height of the image divided by the tangent of half the angle.
  EXPECT_NEAR(viewer.eye.pixels_per_radian, 400.0 / std::tan(0.5), 1e-9);
  EXPECT_NEAR(viewer.eye.forward.y(), 1.0, 1e-12);
  EXPECT_TRUE(sees(viewer.eye, Vec3(3.0, 50.0, 0.0), 1.0));
  EXPECT_FALSE(sees(viewer.eye, Vec3(3.0, -50.0, 0.0), 1.0));
}

TEST(ForestConversions, SensorSurvivesTheRoundTrip) {  // N1
  const forest::Sensor sensor{"lidar", Vec3(1.0, 2.0, 3.0), 30.0, 0.02, 12000000005};
  const forest::Sensor back = fromMsg(toMsg(sensor));
  EXPECT_EQ(back.id, sensor.id);
  EXPECT_EQ(back.position, sensor.position);
  EXPECT_EQ(back.range, sensor.range);
  EXPECT_EQ(back.tolerance, sensor.tolerance);
  EXPECT_EQ(back.stamp, sensor.stamp);
}

TEST(ForestConversions, RefuseASensorWithAllItsFaults) {
  SensorInterest message;
  message.position.x = FOREST_NAN;
  message.range = -1.0;
  message.tolerance = 0.0;
  message.id.assign(257, 'x');
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"sensor: position", "range = -1 m is outside 0 to 1000 m",
        "tolerance = 0 m is outside 0.0001 to 10 m", "id is longer than 256 characters"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

TEST(ForestConversions, RefuseAViewerWithAllItsFaults) {
  Viewer message = exampleViewer();
  message.pose.position.y = FOREST_NAN;
  message.pose.position.z = 1e8;
  message.pose.orientation.w = 3.0;
  message.field_of_view = 3.2;
  message.height = 0;
  message.id.assign(257, 'x');
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"pose.position.y = ", "pose.position.z = 1e+08 m is outside -1e+07 to 1e+07 m",
        "pose.orientation, its norm, = 3.08", "field_of_view = 3.2 rad is outside 0.01 to 3.1 rad",
        "height = 0 pixel is outside 1 to 100000 pixel", "id is longer than 256 characters"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

TEST(ForestConversions, PosesAreMovedToTheFootOfTheTree) {
  const Pose pose{Vec3(0.5, 0.25, 4.0), Quat{0.5, 0.5, -0.5, 0.5}};
  const BranchTransforms message = toMsg(8, Vec3(100.0, 200.0, -3.0), {Pose(), pose});
  EXPECT_EQ(message.tree, 8u);
  ASSERT_EQ(message.poses.size(), 2u);
  EXPECT_EQ(message.poses[0].position.y, 200.0);
  EXPECT_EQ(message.poses[1].position.x, 100.5);
  EXPECT_EQ(message.poses[1].position.z, 1.0);
  EXPECT_EQ(message.poses[1].orientation.y, -0.5);
}

TEST(Stamps, SurviveToTheNanosecond) {
  const Nanoseconds stamp = 1700000000123456789;
  EXPECT_EQ(fromMsg(toStamp(stamp)), stamp);
  EXPECT_EQ(toStamp(-5), ros::Time());
}

}  // namespace
}  // namespace vegetation_sim
