// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/CrowdView.h>
#include <vegetation_sim/ForestLayout.h>

#include <limits>

#include "crowd/agents/crowd.h"
#include "ros/conversions/crowd_conversions.h"
#include "rviz/crowd/crowd_display.h"
#include "rviz/rigs/display_checks.h"

namespace vegetation_sim {
namespace {

/// rviz and a crowd that the rig moves.
class CrowdRig : public ViewRig {
 public:
  CrowdRig() { startNode(); }

  /// Starts a node that publishes the people. A node that already runs is stopped.
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
  /// Publishes the crowd without motion. All people stay in the image, however often a slow rviz
  /// needs the message.
  void report() {
    setTime(now() + 0.1);
    publish(message());
  }
  /// Walks for some time and publishes once.
  void walk(double seconds) {
    for (double t = 0.0; t < seconds; t += 0.1) {
      setTime(now() + 0.1);
      crowd_->advance(fromSeconds(now()));
    }
    publish(message());
  }
  void publish(const AgentStates& message) { agents_.publish(message); }
  CrowdView view() const {
    CrowdView out = toView(crowd_->walkers(), crowd_->terrain());
    out.header = message().header;
    return out;
  }
  /// Number of displays that read the full people.
  std::uint32_t readers() const { return agents_.getNumSubscribers(); }

 private:
  ros::Publisher agents_;
  std::unique_ptr<crowd::Crowd> crowd_;
};

// rviz can be started only once in a process, so all tests share one rig. Each test has its own
// display.
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

// S2-35: bodies of several colours stand on a lit ground.
TEST_F(CrowdDisplayTest, DrawsPeopleOnGrassUnderASky) {
  rig.frames(10);
  const ImageStatistics seen = rig.imageStatistics();
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

// A display reads the full people only while nobody publishes the rounded ones; both look alike.
TEST_F(CrowdDisplayTest, ReadsRoundedPeopleWhereTheyArePublished) {
  rig.report();
  rig.frames(10);
  EXPECT_EQ(rig.readers(), 1u);
  const std::vector<std::uint8_t> full = rig.picture();
  ros::Publisher rounded = rig.nodeHandle().advertise<CrowdView>("agents/view", 10);
  EXPECT_TRUE(rig.until([&] { return rig.readers() == 0; }));
  const int built = display->drawn().rebuilds;
  rounded.publish(rig.view());
  EXPECT_TRUE(rig.until([&] { return display->drawn().rebuilds > built; }));
  EXPECT_LT(difference(full, rig.picture()), 0.1);
  rig.gather(5);
  rounded.publish(rig.view());
  EXPECT_TRUE(rig.until([&] { return display->drawn().people == 5; }));
  CrowdView bad = rig.view();
  bad.gait.pop_back();
  rounded.publish(bad);
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*display, "People").find("gait has 4 numbers") != std::string::npos;
  }));
  EXPECT_EQ(display->drawn().people, 5u);
  rounded.shutdown();
  EXPECT_TRUE(rig.until([&] { return rig.readers() == 1; }));
}

// This applies S2-15 to people: distant people are drawn with fewer triangles.
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

TEST_F(CrowdDisplayTest, RejectsInvalidNumbersAndKeepsItsState) {
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

// SetUp() may leave messages under way. They would bring the people back after the jump, so one
// that differs is awaited first.
TEST_F(CrowdDisplayTest, SurvivesTimeGoingBack) {
  rig.gather(7);
  rig.report();
  ASSERT_TRUE(rig.until([&] { return display->drawn().drawn == 7; }));
  rig.setTime(rig.now() - 50.0);
  EXPECT_TRUE(rig.until([&] { return display->drawn().people == 0; }));
  EXPECT_TRUE(rig.until([&] {
    rig.report();  // rviz has subscribed again.
    return display->drawn().drawn == 7;
  }));
}

TEST_F(CrowdDisplayTest, PeopleDisappearWhenTheirNodeDies) {
  rig.setTime(rig.now() + 1.0);
  rig.frames(10);
  EXPECT_EQ(display->drawn().people, 8u);
  rig.setTime(rig.now() + 3.5);
  EXPECT_TRUE(rig.until([&] { return display->drawn().people == 0; }));
  rig.report();  // The node returns.
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
TEST_F(CrowdDisplayTest, ShowsTheGovernorsChoice) {
  expectAllocationIsReported(rig, *display, "agent_crowd", "Cost [points]", "Budget [points]",
                             "points");
}

TEST_F(CrowdDisplayTest, EveryPropertyCanBeChanged) {
  expectEveryPropertyCanBeChanged(rig, *display);
  EXPECT_TRUE(rig.until([&] {
    rig.report();  // There were no people on the other topic.
    return display->drawn().drawn == 8;
  }));
}

TEST_F(CrowdDisplayTest, SettingsSurviveSaveAndLoad) {
  expectSettingsSurvive(rig, *display, [&] { return rig.addDisplay(); });
}

// There is one ground and one sky: the first display draws them, and another display takes over
// when the first is removed.
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
  EXPECT_GT(rig.imageStatistics().green, 0.2);
}

// The ground is built again for another terrain.
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
