// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/ForestLayout.h>

#include <limits>

#include "crowd/agents/crowd.h"
#include "ros/conversions/crowd_conversions.h"
#include "rviz/crowd/crowd_display.h"
#include "rviz/rigs/display_checks.h"

namespace vegetation_sim {
namespace {

/// rviz and a crowd that the rig walks.
class CrowdRig : public ViewRig {
 public:
  CrowdRig() { startNode(); }

  /// A node that publishes the people; one that ran dies.
  void startNode() {
    agents_.shutdown();
    agents_ = nh_.advertise<AgentStates>("agents", 10);
  }

  CrowdDisplay* addDisplay() { return add<CrowdDisplay>("vegetation_sim/CrowdDisplay"); }

  void gather(int people) {
    crowd_ = std::make_unique<crowd::Crowd>(3, crowd::CrowdSettings(), crowd::Area(),
                                            std::make_shared<const terrain::HeightMap>());
    for (int i = 0; i < people; ++i) {
      crowd::Spawn spawn;
      spawn.position = {1.5 * (i % 4) - 2.0, 1.5 * (i / 4) - 2.0};
      crowd_->spawn(spawn);
    }
  }
  AgentStates message() const {
    AgentStates out;
    out.header.frame_id = "map";
    out.header.stamp.fromSec(now());
    for (const crowd::Walker& walker : crowd_->walkers())
      out.agents.push_back(toMsg(walker, crowd_->terrain()));
    return out;
  }
  /// Nobody moves: however often a slow rviz has to be told, all stay in the picture.
  void report() {
    setTime(now() + 0.1);
    publish(message());
  }
  /// Walks for a while and tells once.
  void walk(double seconds) {
    for (double t = 0.0; t < seconds; t += 0.1) {
      setTime(now() + 0.1);
      crowd_->advance(fromSeconds(now()));
    }
    publish(message());
  }
  void publish(const AgentStates& message) { agents_.publish(message); }

 private:
  ros::Publisher agents_;
  std::unique_ptr<crowd::Crowd> crowd_;
};

// rviz can only be started once in a process: one rig for all tests, a fresh display for each.
std::unique_ptr<CrowdRig> shared_rig;

class CrowdDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<CrowdRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override {
    rig.gather(8);
    display = rig.addDisplay();
    ASSERT_NE(display, nullptr) << "the plugin is not found or is another class";
    rig.lookAt(0.9f, 0.2, 9.0);
    ASSERT_TRUE(rig.until([&] {
      rig.report();
      return display->drawn().drawn == 8;
    }));
  }
  void TearDown() override {
    if (display != nullptr) rig.remove(display);
  }

  CrowdRig& rig{*shared_rig};
  CrowdDisplay* display{nullptr};
};

// S2-35: bodies on a lit ground, more than one colour of them.
TEST_F(CrowdDisplayTest, DrawsPeopleOnGrassUnderASky) {
  rig.frames(10);
  const Impression seen = rig.look();
  EXPECT_GT(seen.green, 0.2);
  EXPECT_GT(seen.blue, 0.05);
  const std::vector<std::uint8_t> with = rig.picture();
  rig.gather(0);
  rig.report();
  ASSERT_TRUE(rig.until([&] { return display->drawn().people == 0; }));
  rig.frames(3);
  EXPECT_GT(difference(with, rig.picture()), 1.0);
}

TEST_F(CrowdDisplayTest, PeopleWalk) {
  const std::vector<std::uint8_t> before = rig.picture();
  rig.walk(1.0);
  EXPECT_TRUE(rig.until([&] { return difference(before, rig.picture()) > 0.3; }));
}

// S2-15 in spirit: who is far away is drawn with less.
TEST_F(CrowdDisplayTest, FarPeopleCostLess) {
  const std::size_t near = display->drawn().triangles;
  rig.lookAt(0.9f, 0.2, 120.0);
  EXPECT_TRUE(rig.until([&] {
    return display->drawn().drawn == 8 && 3 * display->drawn().triangles < near;
  })) << display->drawn().triangles
      << " of " << near;
}

TEST_F(CrowdDisplayTest, DrawsTheNearestOnly) {
  display->subProp("Most People")->setValue(3);
  EXPECT_TRUE(rig.until([&] { return display->drawn().drawn == 3; }));
  EXPECT_EQ(display->drawn().people, 8u);
}

TEST_F(CrowdDisplayTest, RefusesWhatIsNoNumberAndKeepsWhatItHas) {
  AgentStates bad = rig.message();
  bad.agents[2].pose.position.x = std::numeric_limits<double>::quiet_NaN();
  rig.publish(bad);
  EXPECT_TRUE(
      rig.until([&] { return statusOf(*display, "People").find("agent 2") != std::string::npos; }));
  bad = rig.message();
  bad.agents[1].height = -1.0;
  rig.publish(bad);
  EXPECT_TRUE(
      rig.until([&] { return statusOf(*display, "People").find("height") != std::string::npos; }));
  EXPECT_EQ(display->drawn().drawn, 8u);
}

TEST_F(CrowdDisplayTest, SurvivesTimeGoingBack) {
  rig.setTime(rig.now() - 50.0);
  EXPECT_TRUE(rig.until([&] { return display->drawn().people == 0; }));
  EXPECT_TRUE(rig.until([&] {
    rig.report();  // rviz listens anew
    return display->drawn().drawn == 8;
  }));
}

TEST_F(CrowdDisplayTest, NobodyIsLeftWhenTheirNodeDies) {
  rig.setTime(rig.now() + 1.0);
  rig.frames(10);
  EXPECT_EQ(display->drawn().people, 8u);
  rig.setTime(rig.now() + 3.5);
  EXPECT_TRUE(rig.until([&] { return display->drawn().people == 0; }));
  rig.report();  // it returns
  EXPECT_TRUE(rig.until([&] { return display->drawn().people == 8; }));
}

TEST_F(CrowdDisplayTest, SurvivesAFlood) {
  for (int i = 0; i < 2000; ++i) rig.publish(rig.message());
  rig.report();
  rig.frames(5);
  EXPECT_TRUE(rig.until([&] { return display->drawn().drawn == 8; }));
}

TEST_F(CrowdDisplayTest, FollowsANodeThatDiesAndReturns) {
  expectReloadsAreFollowed(
      rig,
      [&](int scene) {
        rig.startNode();
        rig.gather(scene == 0 ? 8 : 3);
      },
      [&](int scene) {
        rig.report();
        return display->drawn().drawn == (scene == 0 ? 8u : 3u);
      });
}

// N7
TEST_F(CrowdDisplayTest, TellsTheGovernorsChoice) {
  expectAllocationIsReported(rig, *display, "agent_crowd", "Cost [points]", "Budget [points]",
                             "points");
}

TEST_F(CrowdDisplayTest, EveryPropertyCanBeChanged) {
  expectEveryPropertyCanBeChanged(rig, *display);
  EXPECT_TRUE(rig.until([&] {
    rig.report();  // another topic had nobody
    return display->drawn().drawn == 8;
  }));
}

TEST_F(CrowdDisplayTest, SettingsSurviveSaveAndLoad) {
  expectSettingsSurvive(rig, *display, [&] { return rig.addDisplay(); });
}

// One ground, one sky: whoever came first draws them, and the other when that one goes.
TEST_F(CrowdDisplayTest, TwoDrawOneScenery) {
  CrowdDisplay* other = rig.addDisplay();
  rig.report();
  ASSERT_TRUE(rig.until([&] {
    rig.report();
    return other->drawn().drawn == 8 &&
           statusOf(*other, "Scenery").find("ground by") != std::string::npos;
  }));
  rig.remove(display);
  display = other;
  EXPECT_TRUE(rig.until([&] { return statusOf(*other, "Scenery") == "As set here"; }));
  EXPECT_GT(rig.look().green, 0.2);
}

// The ground is made anew where the terrain is another.
TEST_F(CrowdDisplayTest, TheGroundFollowsTheTerrain) {
  ros::Publisher layout = rig.nodeHandle().advertise<ForestLayout>("forest/layout", 1, true);
  ForestLayout message;
  message.header.frame_id = "map";
  layout.publish(message);
  rig.frames(5);
  const std::vector<std::uint8_t> flat = rig.picture();
  message.terrain = "package://vegetation_sim/config/terrain/hills.yaml";
  layout.publish(message);
  EXPECT_TRUE(rig.until([&] { return rig.largestChange(flat, rig.picture()) > 20.0; }));
  message.terrain.clear();
  layout.publish(message);
  EXPECT_TRUE(rig.until([&] { return rig.largestChange(flat, rig.picture()) < 1.0; }));
}

TEST_F(CrowdDisplayTest, LeavesNothingBehind) {
  rig.remove(display);
  display = nullptr;
  expectNothingLeftBehind(
      rig, [&] { return rig.addDisplay(); },
      [&](rviz::Display& another) {
        rig.report();
        return static_cast<CrowdDisplay&>(another).drawn().drawn > 0;
      });
}

TEST_F(CrowdDisplayTest, StandsInAnyFixedFrame) {
  expectStandsInAnyFixedFrame(rig, *display);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "crowd_display_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
