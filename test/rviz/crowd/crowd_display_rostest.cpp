// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <vegetation_sim/AgentStates.h>
#include <vegetation_sim/CrowdView.h>
#include <vegetation_sim/ForestLayout.h>
#include <visualization_msgs/MarkerArray.h>

#include <limits>

#include "crowd/agents/crowd.h"
#include "ros/conversions/crowd_conversions.h"
#include "rviz/crowd/crowd_display.h"
#include "rviz/rigs/display_checks.h"
#include "rviz/rigs/display_rig.h"
#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim {
namespace {

/// rviz, a crowd that the rig moves, and the trees of DisplayRig.
class CrowdRig : public DisplayRig {
 public:
  CrowdRig() { startNode(); }

  ForestDisplay* addForest() { return DisplayRig::addDisplay(); }

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

/// A marker at the origin, and a display of rviz that shows it.
struct ShownMarker {
  ShownMarker(ViewRig& rig, int type, double size)
      : display(rig.manager().createDisplay("rviz/MarkerArray", "Markers", true)),
        publisher(rig.nodeHandle().advertise<visualization_msgs::MarkerArray>("solids", 1, true)) {
    display->subProp("Marker Topic")->setValue("solids");
    message.markers.resize(1);
    visualization_msgs::Marker& solid = message.markers.front();
    solid.header.frame_id = "map";
    solid.type = type;
    solid.pose.position.z = 0.3;
    solid.pose.orientation.w = 1.0;
    solid.scale.x = solid.scale.y = solid.scale.z = size;
  }

  rviz::Display* display;
  ros::Publisher publisher;
  visualization_msgs::MarkerArray message;
};

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
  /// Shows a marker from above, and returns how many values are darker with its shadows.
  int darkenedBy(const ShownMarker& shown) {
    const std::vector<std::uint8_t> empty = steadyPicture(rig);
    shown.publisher.publish(shown.message);
    rig.lookAt(0.f, 1.2, 5.0);
    EXPECT_TRUE(rig.until([&] {
      rig.frames(1);
      return rig.largestChange(empty, rig.picture()) > 20.0;
    }));
    display->subProp("Ground")->subProp("Robot Shadows")->setValue(false);
    const std::vector<std::uint8_t> without = steadyPicture(rig);
    display->subProp("Ground")->subProp("Robot Shadows")->setValue(true);
    const std::vector<std::uint8_t> with = steadyPicture(rig);
    int darker = 0;
    for (std::size_t i = 0; i < with.size(); ++i) darker += int{with[i]} < int{without[i]} - 15;
    std::cout << darker << " darker values\n";
    return darker;
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

// Returns the mean brightness of an image at pixels, 0 to 255.
double brightnessAt(const std::vector<std::uint8_t>& image,
                    const std::vector<std::size_t>& pixels) {
  double sum = 0.0;
  for (const std::size_t pixel : pixels)
    for (std::size_t k = 0; k < 3; ++k) sum += image[3 * pixel + k];
  return sum / (3.0 * static_cast<double>(std::max<std::size_t>(1, pixels.size())));
}

// The same people are seen with trees around them and without. Pixels of people are those that
// change, in both scenes, when the people go.
TEST_F(CrowdDisplayTest, PeopleUnderTreesAreDarker) {
  display->subProp("Shadows")->setValue(false);
  display->subProp("Contact Shadows")->setValue(false);
  display->subProp("Most People")->setValue(8);
  rig.lookAt(0.9f, 0.1, 9.0);
  std::vector<std::vector<std::uint8_t>> people, empty;
  ForestDisplay* forest = nullptr;
  for (const bool trees : {false, true}) {
    if (trees) {
      forest::Layout layout = forest::gridLayout(4, 5.0);
      for (forest::TreeSeed& seed : layout.trees) seed.position -= Vec3(7.5, 7.5, 0.0);
      rig.publishForest(layout);
      forest = rig.addForest();
      ASSERT_TRUE(rig.until([&] { return forest->drawn().trees == 16; }));
    }
    for (const int count : {8, 0}) {
      rig.gather(count);
      rig.report();
      rig.publishState();
      ASSERT_TRUE(
          rig.until([&] { return display->drawn().people == static_cast<std::size_t>(count); }));
      (count > 0 ? people : empty).push_back(steadyPicture(rig));
    }
  }
  std::vector<std::size_t> pixels;
  for (std::size_t i = 0; 3 * i + 2 < people[0].size(); ++i) {
    const auto change = [&](std::size_t scene) {
      int out = 0;
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
        out += std::abs(int{people[scene][k]} - int{empty[scene][k]});
      return out;
    };
    if (change(0) > 45 && change(1) > 45) pixels.push_back(i);
  }
  const double open = brightnessAt(people[0], pixels), shaded = brightnessAt(people[1], pixels);
  std::cout << pixels.size() << " pixels of people: " << open << " in the open, " << shaded
            << " under trees\n";
  EXPECT_GT(pixels.size(), 500u);
  EXPECT_LT(shaded, 0.75 * open);
  rig.remove(forest);
  rig.publishForest(forest::Layout());
}

// With the property, the ground is darker next to the feet; nothing is brighter.
TEST_F(CrowdDisplayTest, FeetDarkenTheGround) {
  rig.lookAt(0.f, 1.2, 5.0);
  display->subProp("Shadows")->setValue(false);
  display->subProp("Contact Shadows")->setValue(false);
  const std::vector<std::uint8_t> without = steadyPicture(rig);
  display->subProp("Contact Shadows")->setValue(true);
  const std::vector<std::uint8_t> with = steadyPicture(rig);
  int darker = 0, brighter = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    darker += int{with[i]} < int{without[i]} - 15 ? 1 : 0;
    brighter += int{with[i]} > int{without[i]} + 5 ? 1 : 0;
  }
  std::cout << darker << " darker values, " << brighter << " brighter\n";
  EXPECT_GT(darker, 500);
  EXPECT_LT(brighter, 20);
}

// A box that a marker draws darkens the ground of the display that owns it. The box is seen from
// above and hides the same ground in both pictures.
TEST_F(CrowdDisplayTest, RobotsAndMarkersDarkenTheGround) {
  ShownMarker shown(rig, visualization_msgs::Marker::CUBE, 0.6);
  visualization_msgs::Marker& box = shown.message.markers.front();
  box.color.r = box.color.a = 1.f;
  EXPECT_GT(darkenedBy(shown), 500);
  // One that shines through casts none.
  box.color.a = 0.3f;
  shown.publisher.publish(shown.message);
  const std::vector<std::uint8_t> glass = steadyPicture(rig);
  display->subProp("Ground")->subProp("Robot Shadows")->setValue(false);
  EXPECT_LT(rig.largestChange(glass, steadyPicture(rig)), 1.0);
  rig.remove(shown.display);
}

// So does the stone of scripts/rolling_stone.py, no part of which is black.
TEST_F(CrowdDisplayTest, AStoneDarkensTheGround) {
  ShownMarker shown(rig, visualization_msgs::Marker::MESH_RESOURCE, 0.45);
  visualization_msgs::Marker& stone = shown.message.markers.front();
  stone.mesh_resource = "package://vegetation_sim/media/stone/stone.obj";
  stone.mesh_use_embedded_materials = true;
  EXPECT_GT(darkenedBy(shown), 500);
  rig.lookAt(0.3f, 0.3, 1.2);  // It fills the middle of the picture.
  const std::vector<std::uint8_t> pixels = steadyPicture(rig);
  const auto width = static_cast<std::size_t>(rig.panel().getRenderWindow()->getWidth());
  const std::size_t height = pixels.size() / 3 / width;
  std::array<std::uint8_t, 2> range{255, 0};
  for (std::size_t row = height / 3; row < 2 * height / 3; ++row) {
    for (std::size_t column = width / 3; column < 2 * width / 3; ++column) {
      const std::uint8_t green = pixels[3 * (row * width + column) + 1];
      range = {std::min(range[0], green), std::max(range[1], green)};
    }
  }
  std::cout << "the stone has green from " << int{range[0]} << " to " << int{range[1]} << "\n";
  EXPECT_GT(range[0], 40);
  EXPECT_LT(range[1], 200);
  EXPECT_GT(range[1], range[0] + 20);  // It is mottled.
  rig.remove(shown.display);
}

TEST_F(CrowdDisplayTest, PeopleWalk) {
  const std::vector<std::uint8_t> before = rig.picture();
  rig.walk(1.0);
  EXPECT_TRUE(rig.until([&] { return difference(before, rig.picture()) > 0.3; }));
}

TEST_F(CrowdDisplayTest, PeopleWalkOnBetweenMessages) {
  rig.walk(1.0);
  const std::vector<std::uint8_t> before = steadyPicture(rig);
  rig.setTime(rig.now() + 0.2);  // without a message
  EXPECT_TRUE(rig.until([&] { return difference(before, rig.picture()) > 0.3; }))
      << difference(before, rig.picture());
}

// S2-35: people who stand hold their arms as the styles of the node say.
TEST_F(CrowdDisplayTest, BodiesHaveTheStylesOfTheNode) {
  const std::vector<std::uint8_t> own = steadyPicture(rig);
  const ros::Publisher styles = rig.nodeHandle().advertise<CrowdMotions>("agents/motions", 1, true);
  styles.publish(toMsg(crowd::armsToTheFront()));
  ASSERT_TRUE(rig.until([&] { return statusOf(*display, "Styles") == "1 styles"; }))
      << statusOf(*display, "Styles");
  const double change = difference(own, steadyPicture(rig));
  std::cout << "mean change by the style: " << change << " of 255\n";
  EXPECT_GT(change, 0.2);
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
