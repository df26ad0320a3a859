// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Another process rebuilds every branch from layout, wind and state only, with the same result as
// forest_animator, because displays and sensors replicate the forest from these messages.
#include <gtest/gtest.h>
#include <vegetation_sim/Grab.h>
#include <vegetation_sim/Release.h>
#include <vegetation_sim/WindField.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "nodes/rigs/forest_rig.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/forest/forest_replica.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim {
namespace {

using forest::Weights;

// Both processes do the same operations in the same order. The error comes from adding the position
// of the foot.
constexpr double DOUBLE_BAR = 1e-9;  // [m]
// Single precision has an error of 6e-8 per step over about ten joints.
constexpr double FLOAT_BAR = 1e-5;                 // relative to the height of the tree
constexpr std::int64_t KEY_FRAME = 1800 * 944444;  // A tick of key frames in Unix time.

WindField allKinds() {
  std::vector<wind::Primitive> all{forest::makeBreeze(1, Vec3(4, -1, 0)),
                                   forest::makeDisk(2, Vec3(9, 9, 0), 90.0, Vec3(3, 1, 0))};
  for (const wind::Kind kind :
       {wind::Kind::GUST, wind::Kind::TORNADO, wind::Kind::BLAST, wind::Kind::WAKE}) {
    const auto id = static_cast<std::uint32_t>(all.size()) + 1;
    wind::Primitive p = forest::makeDisk(id, Vec3(20.0 * id, 6, 3), 60.0, Vec3(4, 1, 0));
    p.kind = kind;
    p.epoch = TickGrid(30).timeOf(KEY_FRAME);
    p.orbit_radius = kind == wind::Kind::WAKE ? 20.0 : 0.0;
    all.push_back(p);
  }
  return toMsg(wind::Field(all, 5), "map", 0);
}

struct Errors {
  double metres{0.0}, turn{0.0}, of_height{0.0};
  std::size_t physical{0};  // number of physical branches
};

class ForestRebuild : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    forest_ = new ClockedForest(KEY_FRAME - 120);
    ros::NodeHandle handle;
    wind_ = new ros::Publisher(handle.advertise<WindField>("wind", 1, true));
    sensor_ = new ros::Publisher(handle.advertise<SensorInterest>("forest/sensors", 10));
    wind_->publish(allKinds());
    for (const ros::Publisher* topic : {wind_, sensor_})
      spinUntil(topic->getTopic(), [&] { return topic->getNumSubscribers() > 0; });
    forest_->runUntil("the wind", [] {
      return !forest_->state.messages.empty() &&
             forest_->state.messages.back().wind_hash == allKinds().hash;
    });
    forest_->runUntil("the second before a key frame", [] {
      return fromMsg(forest_->state.last().header.stamp) >= forest_->grid().timeOf(KEY_FRAME - 30);
    });
    publishSensor("lidar", -15.0);
    publishSensor("distant", 120.0);
    forest_->runUntil("a key frame", [] { return forest_->state.last().key_frame; });
    key_frame_ = forest_->state.messages.size() - 1;
  }
  static void TearDownTestSuite() {
    delete sensor_;
    delete wind_;
    delete forest_;
  }

  /// Moves a sensor eastwards along the row of trees.
  static void publishSensor(const std::string& id, double x) {
    SensorInterest message;
    message.id = id;
    message.header.frame_id = "map";
    message.position.x = x;
    message.position.z = 5.0;
    message.range = 60.0;
    message.tolerance = 0.02;
    sensor_->publish(message);
    forest_->settle();
  }

  /// A process that has received only the latched layout, the wind and the key frame.
  static forest::ForestReplica listener() {
    LatestMessage<ForestLayout> layout("forest/layout");
    LatestMessage<WindField> wind("wind");
    forest::ForestReplica out;
    out.setLayout(fromMsg(layout.last()), loadTerrain(layout.last().terrain));
    out.setWind(fromMsg(wind.last()));
    if (!out.apply(fromMsg(forest_->state.messages[key_frame_])))
      throw std::runtime_error(out.why());
    return out;
  }

  /// Returns the largest errors of all branches of all trees at the stamp of the replica.
  static Errors compare(const forest::ForestReplica& replica) {
    Errors out;
    for (std::uint32_t id = 0; id < replica.layout().treeCount(); ++id) {
      const GetTree::Response published = forest_->ask(id, toStamp(replica.stamp()));
      const forest::Tree tree = replica.grow(id);
      EXPECT_TRUE(published.success) << published.message;
      EXPECT_EQ(published.skeleton_hash, tree.skeleton.hash());  // S1-04
      EXPECT_EQ(published.level, replica.levelOf(id).level);
      const auto poses = replica.pose(tree, id, replica.stamp());
      forest::BatchPoses fast;
      forest::BatchPoser(tree).pose(replica.wind().at(replica.stamp()).relativeTo(tree.foot),
                                    replica.weights(id, replica.stamp()), forest::MAX_DEPTHS, fast);
      const auto promoted = replica.promoted(id).branches;
      EXPECT_EQ(promoted.size(), published.physical.size());
      if (!promoted.empty() || replica.modalState(id))
        narrowPoses(poses, fast);  // Displays pose such a tree in this way.
      out.physical += promoted.size();
      if (poses.size() != published.transforms.poses.size())
        throw std::runtime_error("other branches");
      for (std::size_t i = 0; i < poses.size(); ++i)
        addErrors(published.transforms.poses[i], tree, poses[i], fast.at(static_cast<int>(i)), out);
    }
    return out;
  }

  static void addErrors(const geometry_msgs::Pose& published, const forest::Tree& tree,
                        const Pose& exact, const Pose& fast, Errors& out) {
    const Vec3 at(published.position.x, published.position.y, published.position.z);
    const auto& q = published.orientation;
    const Quat& e = exact.orientation;
    out.metres = std::max(out.metres, length(tree.foot + exact.position - at));
    for (const double difference : {q.w - e.w, q.x - e.x, q.y - e.y, q.z - e.z})
      out.turn = std::max(out.turn, std::fabs(difference));
    out.of_height =
        std::max(out.of_height, length(tree.foot + fast.position - at) / tree.skeleton.height);
  }

  /// Grabs a limb and pulls it sideways.
  static void grab(std::uint32_t tree, std::uint32_t branch) {
    Grab call;
    call.request.tree = tree;
    call.request.branch = branch;
    call.request.target.point = forest_->ask(tree).transforms.poses[branch].position;
    call.request.target.point.x += 0.3;
    call.request.has_lease = true;
    call.request.lease = 60.0;
    ASSERT_TRUE(ros::service::call("forest_animator/grab", call));
    ASSERT_TRUE(call.response.success) << call.response.message;
  }

  static Errors expectEqual(const forest::ForestReplica& replica, const char* what) {
    const Errors errors = compare(replica);
    printf("%s: double %.2e m, %.2e of the quaternion; float %.2e of the height\n", what,
           errors.metres, errors.turn, errors.of_height);
    EXPECT_LE(errors.metres, DOUBLE_BAR);
    EXPECT_LE(errors.turn, DOUBLE_BAR);
    EXPECT_LE(errors.of_height, FLOAT_BAR);
    return errors;
  }

  /// The scene is a demanding one: it has several levels, trees in transition and bent trees.
  static void expectLively(const forest::ForestReplica& replica) {
    std::set<int> levels;
    int between = 0;
    double bent = 0.0;
    for (std::uint32_t id = 0; id < replica.layout().treeCount(); ++id) {
      levels.insert(replica.levelOf(id).level);
      const Weights weights = replica.weights(id, replica.stamp());
      between += std::any_of(weights.begin(), weights.end(),
                             [](double weight) { return weight > 0.0 && weight < 1.0; });
      const forest::Tree tree = replica.grow(id);
      const auto poses = replica.pose(tree, id, replica.stamp());
      for (std::size_t i = 0; i < poses.size(); ++i)
        bent = std::max(bent, length(poses[i].position - tree.skeleton.branches[i].rest.position));
    }
    EXPECT_GE(levels.size(), 3u);
    EXPECT_GE(between, 3);
    EXPECT_GT(bent, 0.01);
  }

  static ClockedForest* forest_;
  static ros::Publisher *wind_, *sensor_;
  static std::size_t key_frame_;  // index of the message
};
ClockedForest* ForestRebuild::forest_ = nullptr;
ros::Publisher* ForestRebuild::wind_ = nullptr;
ros::Publisher* ForestRebuild::sensor_ = nullptr;
std::size_t ForestRebuild::key_frame_ = 0;

bool sameBits(const forest::BatchPoses& a, const forest::BatchPoses& b) {
  const auto same = [&](const std::vector<float>& one, const std::vector<float>& other) {
    const std::size_t size = sizeof(float) * static_cast<std::size_t>(a.count);
    return std::memcmp(one.data(), other.data(), size) == 0;
  };
  return a.count == b.count && same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) &&
         same(a.qw, b.qw) && same(a.qx, b.qx) && same(a.qy, b.qy) && same(a.qz, b.qz);
}

// S1-04, S1-22, S1-23, N2: layout, wind and one key frame are sufficient while levels change.
TEST_F(ForestRebuild, OneKeyFrameIsEnough) {
  const forest::ForestReplica late = listener();
  expectLively(late);
  expectEqual(late, "one key frame");
}

// The poses are the same bit for bit in single precision, whatever instruction set the reader's
// processor has.
TEST_F(ForestRebuild, FloatPosesHaveTheSameBitsOnEveryInstructionSet) {
  const forest::ForestReplica late = listener();
  const std::vector<std::string> sets = forest::instructionSets();
  ASSERT_GE(sets.size(), 2u);
  for (std::uint32_t id = 0; id < late.layout().treeCount(); ++id) {
    const forest::Tree tree = late.grow(id);
    const auto wind = late.wind().at(late.stamp()).relativeTo(tree.foot);
    const Weights weights = late.weights(id, late.stamp());
    forest::BatchPoses chosen, other;
    forest::BatchPoser(tree).pose(wind, weights, forest::MAX_DEPTHS, chosen);
    for (const std::string& set : sets) {
      forest::forceInstructionSet(set);
      forest::BatchPoser(tree).pose(wind, weights, forest::MAX_DEPTHS, other);
      EXPECT_TRUE(sameBits(chosen, other)) << set << " tree " << id;
    }
    forest::forceInstructionSet("");
  }
}

// A reader continues with deltas only while sensors appear, move to and fro and leave.
TEST_F(ForestRebuild, DeltasAreFollowed) {
  forest::ForestReplica reader = listener();
  for (int second = 0; second < 12; ++second) {
    if (second < 10) publishSensor("lidar", 40.0 * (second % 5));
    if (second == 2) publishSensor("other", 300.0);
    forest_->run(second == 11 ? 20 : 30);  // The run ends while levels change.
  }
  std::size_t changed = 0;
  for (std::size_t i = key_frame_ + 1; i < forest_->state.messages.size(); ++i) {
    const ForestState& message = forest_->state.messages[i];
    EXPECT_FALSE(message.key_frame);
    changed += message.trees.size();
    ASSERT_TRUE(reader.apply(fromMsg(message))) << reader.why();
  }
  EXPECT_GT(changed, 20u);
  expectEqual(reader, "deltas");
}

// S1-34, S1-35: this also holds for physical branches, held and on their way back.
TEST_F(ForestRebuild, GrabbedTreesAreFollowed) {
  forest::ForestReplica reader = listener();
  std::size_t next = key_frame_ + 1;
  const auto follow = [&](int ticks) {
    forest_->run(ticks);
    for (; next < forest_->state.messages.size(); ++next)
      ASSERT_TRUE(reader.apply(fromMsg(forest_->state.messages[next]))) << reader.why();
  };
  grab(0, 9);
  grab(2, 12);
  follow(40);
  EXPECT_GT(expectEqual(reader, "two grabs").physical, 10u);
  Release call;
  call.request.all = true;
  ASSERT_TRUE(ros::service::call("forest_animator/release", call));
  follow(10);
  EXPECT_GT(expectEqual(reader, "let go").physical, 10u);
  const auto blending = [&] {
    const auto branches = reader.promoted(0).branches;
    return std::any_of(branches.begin(), branches.end(),
                       [](const auto& branch) { return branch.blend != forest::NEVER; });
  };
  for (int i = 0; i < 300 && !blending(); ++i) follow(1);
  EXPECT_TRUE(blending());
  follow(15);
  expectEqual(reader, "blending");
  for (int i = 0; i < 300 && !reader.physicalTrees().empty(); ++i) follow(1);
  EXPECT_EQ(expectEqual(reader, "procedural again").physical, 0u);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_rebuild_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
