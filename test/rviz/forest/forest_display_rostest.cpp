// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rviz/properties/property_tree_model.h>
#include <rviz/view_controller.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "rviz/render/batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"
#include "rviz/rigs/display_checks.h"
#include "rviz/rigs/display_rig.h"
#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim {
namespace {

constexpr int TREES = 16;
const Ogre::Vector3 SHADE(9.f, 13.5f, 0.f);  // on open ground, shaded by a tree

// rviz can be started only once in a process, so all tests share one rig. Each test has its own
// display.
std::unique_ptr<DisplayRig> shared_rig;

class ForestDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<DisplayRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override {
    rig.setTime(rig.now() + 10.0);
    rig.publishForest(forest::gridLayout(4, 9.0));
    display = rig.addDisplay();
    ASSERT_NE(display, nullptr) << "the plugin is not found or is another class";
    rig.manager().getViewManager()->getCurrent()->lookAt(13.f, 13.f, 4.f);
  }
  void TearDown() override {
    if (display != nullptr) rig.remove(display);
  }

  bool drawn() {
    return rig.until(
        [&] { return display->drawn().trees == TREES && display->drawn().waiting == 0; });
  }
  bool advanceUntil(const std::function<bool()>& done) {
    return rig.until([&] {
      rig.setTime(rig.now() + 0.02);
      return done();
    });
  }
  void expectNoPops();

  DisplayRig& rig{*shared_rig};
  ForestDisplay* display{nullptr};
};

/// A square of leaves above the forest in front of the camera.
class SquareOfLeaves {
 public:
  /// @param distance from the eye [m]; the picture of the square does not depend on it.
  /// @param tilt angle of its plane to the view [rad].
  SquareOfLeaves(DisplayRig& rig, view::Material::Variant variant, double distance, double tilt,
                 const std::array<std::uint8_t, 3>& rgb = {250, 20, 20})
      : texture_(view::uniqueName("square_picture"), {view::Image(16, 16, {1.f, 1.f, 1.f, 1.f})}),
        material_(view::Material::Kind::LEAVES, view::uniqueName("square_material"),
                  {texture_.name()}, variant),
        batch_(view::uniqueName("square"), material_.name()),
        node_(rig.manager().getSceneManager()->getRootSceneNode()->createChildSceneNode()) {
    material_.light(view::Daylight(), Vec3::UnitZ(), view::Haze());
    rig.lookAt(HEIGHT, 0.0, distance);
    const Vec3 away(-std::cos(0.8), -std::sin(0.8), 0.0);  // from the eye, as in lookAt()
    const Vec3 along = std::cos(tilt) * away + std::sin(tilt) * Vec3::UnitZ();
    const Vec3 across = cross(away, Vec3::UnitZ());
    std::vector<float> positions;
    for (const auto& [x, y] :
         {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      const Vec3 at = Vec3(0, 0, HEIGHT) + distance / 6.0 * (x * across + y * along);
      for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(at[k]));
    }
    const view::VertexPaint paint{
        {0.f, 0.f, 1.f}, {rgb[0], rgb[1], rgb[2], 255}, {0.5f, 0.5f, 1.f}};
    batch_.build(positions, std::vector<view::VertexPaint>(4, paint), {0, 1, 2, 0, 2, 3}, 0.f);
    node_->attachObject(&batch_);
  }
  ~SquareOfLeaves() { node_->getCreator()->destroySceneNode(node_); }
  SquareOfLeaves(const SquareOfLeaves&) = delete;
  SquareOfLeaves& operator=(const SquareOfLeaves&) = delete;

 private:
  static constexpr float HEIGHT = 60.f;  // [m]

  view::Texture texture_;
  view::Material material_;
  view::Batch batch_;
  Ogre::SceneNode* node_;
};

// Near the eye, leaves that are seen almost on edge go, but not with the material of others, not
// far away and not from their face.
TEST_F(ForestDisplayTest, LeavesNearTheEyeGoAsTheyAreSeenOnEdge) {
  using Variant = view::Material::Variant;
  const auto redPixels = [&](Variant variant, double distance, double tilt) {
    const SquareOfLeaves square(rig, variant, distance, tilt);
    const std::vector<std::uint8_t> pixels = steadyPicture(rig);
    int out = 0;
    for (std::size_t i = 0; i + 2 < pixels.size(); i += 3)
      out += pixels[i] > 2 * pixels[i + 1] && pixels[i] > 2 * pixels[i + 2] ? 1 : 0;
    return out;
  };
  const int on_edge = redPixels(Variant::NEAR, 3.0, 0.08);
  const int others = redPixels(Variant::WHOLE, 3.0, 0.08);
  const int far = redPixels(Variant::NEAR, 30.0, 0.08);
  const int face = redPixels(Variant::NEAR, 3.0, 0.8);
  std::cout << "red pixels: " << on_edge << " on edge, " << others << " of others, " << far
            << " far away, " << face << " from the face\n";
  EXPECT_GT(others, 500);
  EXPECT_LT(on_edge, others / 10);
  EXPECT_NEAR(far, others, 0.2 * others);
  EXPECT_GT(face, 5 * others);
}

// In full sun, light leaves are brighter than others, but neither cut off nor of a pure colour.
// What has hardly a colour, as clouds, becomes white.
TEST_F(ForestDisplayTest, BrightLeavesBecomePaler) {
  using Variant = view::Material::Variant;
  const auto colourInSun = [&](const std::array<std::uint8_t, 3>& colour) {
    const SquareOfLeaves square(rig, Variant::WHOLE, 3.0, 0.8, colour);
    return rig.middleOf(steadyPicture(rig));
  };
  const std::array<int, 3> dark = colourInSun({60, 90, 20});
  const std::array<int, 3> light = colourInSun({120, 160, 45});
  const std::array<int, 3> cloud = colourInSun({200, 200, 195});
  std::cout << "in the sun: " << dark[0] << ' ' << dark[1] << ' ' << dark[2] << ", " << light[0]
            << ' ' << light[1] << ' ' << light[2] << ", " << cloud[0] << ' ' << cloud[1] << ' '
            << cloud[2] << '\n';
  EXPECT_GT(light[1], dark[1] + 20);
  EXPECT_LT(light[1], 230);
  EXPECT_GT(static_cast<double>(light[2]) / light[1], 45.0 / 160.0 + 0.05);
  EXPECT_GT(*std::min_element(cloud.begin(), cloud.end()), 245);
}

// With the property, the ground differs between two instants of a gust; without it, it does not.
// The camera sees ground between the trees and nothing else.
TEST_F(ForestDisplayTest, ShadowsMoveByAProperty) {
  ASSERT_TRUE(drawn());
  rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
  const auto seen = [&](bool moving, double seconds) {
    display->subProp("Moving Shadows")->setValue(moving);
    rig.setTime(rig.now() + seconds);
    EXPECT_TRUE(rig.until([&] { return ros::Time::now().toSec() > rig.now() - 0.01; }));
    rig.frames(5);
    EXPECT_TRUE(rig.until([&] { return !display->drawn().shadows_late; }));
    return steadyPicture(rig);
  };
  view.lookAt(SHADE);
  view.subProp("Pitch")->setValue(1.5);
  view.subProp("Distance")->setValue(2.0);
  const auto still = seen(false, 0.0), later = seen(false, 1.3);
  const auto levels = display->drawn().per_level;
  EXPECT_LT(rig.largestChange(still, later), 0.1);
  const auto first = seen(true, 0.0), second = seen(true, 1.3);
  const auto moving_levels = display->drawn().per_level;
  const auto again = seen(false, 0.0);
  std::cout << "largest change of 16 x 16 pixels: " << rig.largestChange(still, later)
            << " at rest, " << rig.largestChange(first, second) << " moving\n";
  EXPECT_GT(rig.largestChange(first, second), 0.8);
  EXPECT_LT(rig.largestChange(still, again), 0.1);
  EXPECT_EQ(levels, moving_levels);
  EXPECT_EQ(levels, display->drawn().per_level);
}

// The camera looks at the foot of a tree from above.
TEST_F(ForestDisplayTest, TrunksDarkenTheGroundAroundThem) {
  ASSERT_TRUE(drawn());
  rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
  view.lookAt(9.f, 9.f, 0.f);
  view.subProp("Pitch")->setValue(0.5);
  view.subProp("Distance")->setValue(2.5);
  const std::vector<std::uint8_t> with = steadyPicture(rig);
  display->subProp("Contact Shadows")->setValue(false);
  const std::vector<std::uint8_t> without = steadyPicture(rig);
  int darker = 0, brighter = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    darker += int{with[i]} < int{without[i]} - 8 ? 1 : 0;
    brighter += int{with[i]} > int{without[i]} + 3 ? 1 : 0;
  }
  std::cout << darker << " darker values, " << brighter << " brighter\n";
  EXPECT_GT(darker, 2000);
  EXPECT_LT(brighter, 20);
}

// S2-16: trees are built from the layout at run time and are visible.
TEST_F(ForestDisplayTest, DrawsAForestWithGroundAndSky) {
  ASSERT_TRUE(drawn());
  ASSERT_TRUE(advanceUntil([&] { return display->drawn().moving == TREES; }));
  rig.frames(3);
  const ImageStatistics seen = rig.imageStatistics();
  EXPECT_GT(seen.green, 0.15);
  EXPECT_GT(seen.blue, 0.05);
  EXPECT_GT(seen.spread, 15.0);
  // The camera faces upwards: the sky has clouds and gets paler towards the horizon.
  rig.lookAt(9.f, -0.5, 4.0);
  rig.frames(3);
  EXPECT_LT(rig.imageStatistics().commonest, 0.1);
}

TEST_F(ForestDisplayTest, NothingMovesWhileTheClockStands) {
  ASSERT_TRUE(drawn());
  ASSERT_TRUE(advanceUntil([&] { return display->drawn().moving == TREES; }));
  ASSERT_TRUE(rig.until([&] { return display->drawn().moving == 0; }));
  // After the transitions of levels of detail have ended, all frames are equal.
  std::vector<std::uint8_t> before;
  EXPECT_TRUE(rig.until([&] {
    before = rig.picture();
    rig.frames(10);
    return rig.picture() == before;
  }));
  rig.setTime(rig.now() + 0.5);
  EXPECT_TRUE(rig.until([&] { return rig.picture() != before; }));
}

// Trees behind the camera are neither drawn nor moved. Trees that come into view are in their place
// at once. Moving shadows, which are some frames late, change neither.
TEST_F(ForestDisplayTest, TreesBehindTheCameraAreLeftOutAndDoNotPop) {
  expectNoPops();
}

TEST_F(ForestDisplayTest, TreesBehindTheCameraDoNotPopWithMovingShadows) {
  display->subProp("Moving Shadows")->setValue(true);
  expectNoPops();
}

void ForestDisplayTest::expectNoPops() {
  display->subProp("Update Rate")->setValue(120.f);  // Every frame has an update.
  display->subProp("Triangles")->setValue(1000);  // The coarsest level is used in every direction.
  ASSERT_TRUE(drawn());
  // The camera is at a corner of the box of all trees.
  rig.lookAt(2.f, 0.0, 0.1);
  rig.manager().getViewManager()->getCurrent()->lookAt(30.f, 30.f, 2.f);
  const auto turn = [&](double yaw) {
    rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
    view.subProp("Distance")->setValue(0.1);
    view.subProp("Pitch")->setValue(0.0);
    view.subProp("Yaw")->setValue(yaw);
  };
  const auto triangles = [&] {
    return rig.panel().getRenderWindow()->getStatistics().triangleCount;
  };
  const double in = 0.25 * M_PI, out = 1.25 * M_PI;
  std::vector<std::uint8_t> before;
  const auto isStill = [&] {
    before = rig.picture();
    rig.frames(10);
    const view::ForestReport drawn = display->drawn();
    return rig.picture() == before && drawn.waiting == 0 && !drawn.shadows_late;
  };
  turn(in);
  ASSERT_TRUE(rig.until(isStill));
  const std::size_t all = triangles(), trees = display->drawn().triangles;
  turn(out);
  EXPECT_TRUE(rig.until([&] { return triangles() + trees / 2 < all; }, 20.0))
      << triangles() << " of " << all << ", trees " << trees;
  rig.setTime(rig.now() + 0.7);
  ASSERT_TRUE(rig.until([&] { return ros::Time::now().toSec() > rig.now() - 0.01; }));
  rig.frames(3);
  ASSERT_TRUE(rig.until([&] { return !display->drawn().shadows_late; }));
  const std::vector<std::uint8_t> away = rig.picture(), then = before;
  turn(in);
  std::vector<std::uint8_t> first;
  ASSERT_TRUE(rig.until([&] {
    first = rig.picture();
    return first != away;
  }));
  ASSERT_TRUE(rig.until(isStill));
  std::cout << "pop " << difference(first, before) << " of " << difference(then, before) << "\n";
  EXPECT_TRUE(first == before);
  EXPECT_GT(difference(then, before), 0.0);
}

TEST_F(ForestDisplayTest, SurvivesTimeGoingBack) {
  ASSERT_TRUE(drawn());
  rig.setTime(rig.now() - 50.0);
  ASSERT_TRUE(rig.until([&] { return display->drawn().moving == 0; }));
  rig.publishState();
  EXPECT_TRUE(advanceUntil([&] { return display->drawn().moving == TREES; }));
}

// The forest sends a key frame at once when the clock jumps back. It may arrive before the display
// knows of the jump, and the next one comes much later.
TEST_F(ForestDisplayTest, KeepsTheKeyFrameThatComesWithAJumpBack) {
  ASSERT_TRUE(drawn());
  const auto state = [&] {
    for (auto* property : propertiesOf<rviz::Property>(*display))
      if (property->getName() == "State") return property->getValue().toString().toStdString();
    return std::string();
  };
  ASSERT_TRUE(rig.until([&] { return state() == "In step"; })) << state();
  rig.publishState(rig.now() - 50.0);
  rig.frames(10);  // The key frame has arrived.
  rig.setTime(rig.now() - 49.98);
  rig.frames(40);  // A status is updated twice a second.
  EXPECT_EQ(state(), "In step");
}

// [s]; each step towards a number of triangles waits for transitions of a dozen frames
constexpr double LONG = 240.0;

// S1-14: the complexity of the image follows the setting of the user.
TEST_F(ForestDisplayTest, KeepsToTheTriangles) {
  ASSERT_TRUE(drawn());
  for (const double target : {60000.0, 30000.0, 60000.0}) {
    display->subProp("Triangles")->setValue(static_cast<int>(target));
    EXPECT_TRUE(rig.until(
        [&] {
          const auto triangles = static_cast<double>(display->drawn().triangles);
          return std::abs(triangles / target - 1.0) < 0.1;
        },
        LONG))
        << display->drawn().triangles;
  }
}

// N7: frames that take longer than wanted have fewer triangles, whatever takes the time.
TEST_F(ForestDisplayTest, DrawsFewerTrianglesWhileFramesTakeTooLong) {
  ASSERT_TRUE(drawn());
  constexpr double TARGET = 60000.0;
  display->subProp("Triangles")->setValue(static_cast<int>(TARGET));
  const auto share = [&] { return static_cast<double>(display->drawn().triangles) / TARGET; };
  ASSERT_TRUE(rig.until([&] { return std::abs(share() - 1.0) < 0.1; }, LONG)) << share();
  display->subProp("Frame Time")->setValue(1.0);  // less than any frame takes
  EXPECT_TRUE(rig.until([&] { return share() < 1.0 / 3.0; }, LONG)) << share();
  display->subProp("Frame Time")->setValue(0.0);
  EXPECT_TRUE(rig.until([&] { return share() > 2.0 / 3.0; }, LONG)) << share();
}

// There are more trees than may be drawn. While the camera moves, other trees become the nearest,
// and none of them is ever without a mesh.
TEST_F(ForestDisplayTest, OtherTreesTakeTheirPlaceWithoutAGap) {
  display->subProp("Most Trees")->setValue(300);
  rig.publishForest(forest::gridLayout(24, 4.0));
  const auto standing = [&] {
    const view::ForestReport drawn = display->drawn();
    std::size_t sum = 0;
    for (const std::size_t trees : drawn.per_level) sum += trees;
    return drawn.trees == 300 && sum == 300;
  };
  ASSERT_TRUE(rig.until([&] { return standing() && display->drawn().waiting == 0; }, LONG));
  const int before = display->drawn().tree_sets;
  rviz::ViewController& view = *rig.manager().getViewManager()->getCurrent();
  view.lookAt(60.f, 60.f, 2.f);  // The camera turns there and moves with the distance.
  view.subProp("Distance")->setValue(10.0);
  int bare = 0;
  EXPECT_TRUE(rig.until(
      [&] {
        bare += standing() ? 0 : 1;
        return display->drawn().tree_sets > before && display->drawn().waiting == 0;
      },
      LONG));
  EXPECT_EQ(bare, 0);
}

// S1-13: nothing pops. An update shows at most a fifth of the transition of each tree, and few
// trees change at once. Sometimes two updates happen between two frames.
TEST_F(ForestDisplayTest, LevelsFadeIntoOneAnother) {
  display->subProp("Triangles")->setValue(30000);
  ASSERT_TRUE(drawn());
  const auto settled = [&] {
    const view::ForestReport drawn = display->drawn();
    return drawn.fading == 0 && drawn.waiting == 0;
  };
  const auto triangles = [&] { return display->drawn().triangles; };
  ASSERT_TRUE(rig.until(
      [&] { return std::abs(static_cast<double>(triangles()) / 30000.0 - 1.0) < 0.1 && settled(); },
      LONG));
  rig.frames(3);
  const std::vector<std::uint8_t> before = rig.picture();
  std::vector<std::uint8_t> last = before;
  double step = 0.0;
  display->subProp("Triangles")->setValue(9000);
  ASSERT_TRUE(rig.until(
      [&] {
        const std::vector<std::uint8_t> next = rig.picture();
        step = std::max(step, rig.largestChange(last, next));
        last = next;
        return triangles() < 15000 && settled();
      },
      LONG));
  const double all = rig.largestChange(before, last);
  std::cout << "largest change of a block: " << all << " of 255, between two pictures " << step
            << "\n";
  EXPECT_GT(all, 20.0);
  EXPECT_LT(step, 0.45 * all);
}

// Later versions of rviz set the camera by a property of its view in each frame.
void setFieldOfView(DisplayRig& rig, float radians) {
  rviz::Property* view = rig.manager().getViewManager()->getCurrent();
  for (int i = 0; i < view->numChildren(); ++i)
    if (view->childAt(i)->getName() == "Field of View") view->childAt(i)->setValue(radians);
  rig.camera().setFOVy(Ogre::Radian(radians));
}

// N8: the display publishes the pose of rviz's camera, x forward and z up, on change and at least
// once a second.
TEST_F(ForestDisplayTest, PublishesThePoseOfTheCamera) {
  std::vector<Viewer> received;
  const ros::Subscriber subscriber = rig.nodeHandle().subscribe<Viewer>(
      "viewer", 100, [&](const Viewer::ConstPtr& message) { received.push_back(*message); });
  ASSERT_TRUE(rig.until([&] { return !received.empty(); }));
  const auto forwardOf = [](const Viewer& viewer) {
    const auto& q = viewer.pose.orientation;
    return axisX(Quat{q.w, q.x, q.y, q.z});
  };
  rig.manager().getViewManager()->getCurrent()->subProp("Yaw")->setValue(2.0);
  EXPECT_TRUE(rig.until([&] {
    const Ogre::Vector3 at = rig.camera().getDerivedPosition();
    const Ogre::Vector3 to = rig.camera().getDerivedDirection();
    const Viewer& last = received.back();
    const auto& p = last.pose.position;
    return std::hypot(p.x - static_cast<double>(at.x), p.y - static_cast<double>(at.y)) < 0.02 &&
           length(forwardOf(last) - Vec3(static_cast<double>(to.x), static_cast<double>(to.y),
                                         static_cast<double>(to.z))) < 0.02;
  }));
  EXPECT_EQ(received.back().header.frame_id, "map");
  EXPECT_EQ(received.back().height, 360u);
  EXPECT_EQ(received.back().id.rfind("rviz_", 0), 0u);
  const Ogre::Radian wide = rig.camera().getFOVy();
  EXPECT_NEAR(received.back().field_of_view, static_cast<double>(wide.valueRadians()), 1e-6);
  setFieldOfView(rig, 0.4f);
  rig.panel().resize(480, 300);
  EXPECT_TRUE(rig.until([&] {
    return std::fabs(received.back().field_of_view - 0.4) < 1e-6 && received.back().height == 300u;
  })) << received.back();
  setFieldOfView(rig, wide.valueRadians());
  rig.panel().resize(480, 360);
  rig.frames(2);
  const std::size_t before = received.size();
  // The camera does not move, and messages still arrive.
  EXPECT_TRUE(rig.until([&] { return received.size() >= before + 2; }, 10.0));
}

TEST_F(ForestDisplayTest, RejectsInvalidMessagesAndKeepsItsState) {
  ASSERT_TRUE(drawn());
  ForestLayout layout = toMsg(forest::gridLayout(2, 9.0));
  layout.header.frame_id = "map";
  layout.trees[1].position.x = std::numeric_limits<double>::quiet_NaN();
  rig.publish(layout);
  ForestState unknown;
  unknown.header.stamp.fromSec(rig.now());
  unknown.key_frame = true;
  unknown.layout_hash = 12345;
  rig.publish(unknown);
  WindField wind = toMsg(wind::Field({forest::makeBreeze(1, Vec3(3.0, 0.0, 0.0))}), "map", 0);
  wind.primitives[0].velocity.x = std::numeric_limits<double>::infinity();
  rig.publish(wind);
  const auto refused = [&](const char* name) {
    const auto all = propertiesOf<rviz::Property>(*display);
    return std::any_of(all.begin(), all.end(), [&](rviz::Property* property) {
      return property->getName() == name &&
             property->getValue().toString().contains("is not finite", Qt::CaseInsensitive);
    });
  };
  EXPECT_TRUE(rig.until([&] { return refused("Layout") && refused("Wind"); }));
  EXPECT_EQ(display->drawn().trees, static_cast<std::size_t>(TREES));
}

TEST_F(ForestDisplayTest, FollowsALayoutThatChanges) {
  ASSERT_TRUE(drawn());
  rig.publishForest(forest::gridLayout(3, 9.0));
  EXPECT_TRUE(rig.until([&] { return display->drawn().trees == 9; }));
  rig.publishForest(forest::gridLayout(1, 9.0));
  EXPECT_TRUE(rig.until([&] { return display->drawn().trees == 1; }));
}

TEST_F(ForestDisplayTest, ReportsMissingStates) {
  ASSERT_TRUE(drawn());
  expectSilenceIsReported(rig, *display, [&] { rig.publishState(); });
}

TEST_F(ForestDisplayTest, FollowsANodeThatDiesAndReturns) {
  // All trees at the coarsest level are a defined state.
  display->subProp("Triangles")->setValue(1000);
  expectReloadsAreFollowed(
      rig,
      [&](int scene) {
        rig.startNode();
        rig.publishForest(forest::gridLayout(scene == 0 ? 3 : 2, 9.0));
        for (int i = 0; i < 100; ++i) rig.publishState();
      },
      [&](int scene) {
        return display->drawn().trees == (scene == 0 ? 9u : 4u) && display->drawn().waiting == 0;
      });
}

// N7: the display shows how the forest moves and what its governor reports.
TEST_F(ForestDisplayTest, ShowsLevelsOfMotionAndTheGovernorsChoice) {
  ASSERT_TRUE(drawn());
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*display, "Motion") ==
           "0 trees at rest, moving to depth 1 to 6: 0 0 0 0 0 16; in modes: 0; with physical "
           "branches: 0";
  })) << statusOf(*display, "Motion");
  const std::string published =
      expectAllocationIsReported(rig, *display, "forest_animator", "Predicted frame time [ms]",
                                 "Frame time budget [ms]", "ms");
  // A node that has died is reported although its clock has stopped.
  const std::string missed = "Not heard for 5 s; last: " + published;
  EXPECT_TRUE(rig.until([&] { return statusOf(*display, "Governor") == missed; }))
      << statusOf(*display, "Governor");
}

forest::Layout oneOak() {
  forest::Layout out;
  out.species = {forest::shippedSpecies("oak")};
  out.trees.resize(1);
  return out;
}

// S1-13: as TreeLevels BoughsSaveTrianglesOfNearTrees, for the same oak at the same size.
// Afterwards the display raises the sizes until the target is met again.
TEST_F(ForestDisplayTest, BoughsSaveTrianglesOfANearTree) {
  const forest::Layout oak = oneOak();
  const forest::Skeleton skeleton = forest::grow(oak.trees.front(), oak.species.front());
  const std::size_t whole = forest::buildMesh(skeleton, oak.species.front(),
                                              forest::meshDetail(forest::GEOMETRY_LEVELS - 1))
                                .triangleCount();
  rig.panel().resize(480, 207);  // 250 pixels a radian
  rig.lookAt(static_cast<float>(0.5 * skeleton.height), 0.0, 8.0);
  rig.manager().getViewManager()->getCurrent()->subProp("Yaw")->setValue(0.0);
  rig.frames(3);
  rig.remove(display);  // A new one begins with sizes as they are.
  rig.publishForest(oak);
  display = rig.addDisplay();
  ASSERT_NE(display, nullptr);
  display->subProp("Triangles")->setValue(static_cast<int>(whole));
  const auto becomes = [&](bool by_bough, const std::function<bool(std::size_t)>& fits) {
    display->subProp("Detail by Boughs")->setValue(by_bough);
    EXPECT_TRUE(rig.until([&] {
      const view::ForestReport drawn = display->drawn();
      return drawn.trees == 1 && drawn.waiting == 0 && fits(drawn.triangles);
    })) << display->drawn().triangles
        << " triangles of " << whole << (by_bough ? " by bough" : "");
  };
  const auto is_whole = [&](std::size_t triangles) { return triangles == whole; };
  const auto is_less = [&](std::size_t triangles) {
    return triangles > 0 && 1.3 * static_cast<double>(triangles) < static_cast<double>(whole);
  };
  becomes(false, is_whole);
  rig.frames(10);
  EXPECT_EQ(display->drawn().triangles, whole);
  becomes(true, is_less);
  becomes(false, is_whole);
  rig.panel().resize(480, 360);
  rig.frames(2);
}

/// Shares of pixels with the colours of wood that moves and of wood that is held.
struct StateColours {
  double red{0.0}, yellow{0.0};
};

StateColours stateColours(ViewRig& rig) {
  const std::vector<std::uint8_t> pixels = rig.picture();
  const double count = static_cast<double>(pixels.size()) / 3.0;
  StateColours out;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) {
    const double r = pixels[i], g = pixels[i + 1], b = pixels[i + 2];
    out.red += r > 50.0 && r > 1.8 * g && r > 1.8 * b ? 1.0 / count : 0.0;
    out.yellow += r > 50.0 && g > 0.65 * r && r > 3.0 * b ? 1.0 / count : 0.0;
  }
  return out;
}

// P1, figures of states: what moves is red and what a grab holds is yellow, here the trunk. Wood at
// rest has the colour of bark.
TEST_F(ForestDisplayTest, ColoursByStateShowWhatMovesAndWhatIsHeld) {
  constexpr double NONE = 0.002;
  const ros::Publisher grabs = rig.nodeHandle().advertise<GrabStatuses>("forest/grabs", 1, true);
  rig.publishForest(oneOak());
  display->subProp("Leaves")->setValue(false);
  display->subProp("Ground")->setValue(false);
  rig.lookAt(2.5f, 0.1, 7.0);
  ASSERT_TRUE(
      rig.until([&] { return display->drawn().trees == 1 && display->drawn().waiting == 0; }));
  steadyPicture(rig);
  const StateColours natural = stateColours(rig);
  EXPECT_LT(natural.red, NONE);
  EXPECT_LT(natural.yellow, NONE);
  display->subProp("Colours")->setValue("by state");
  EXPECT_TRUE(advanceUntil([&] { return stateColours(rig).red > 0.01; })) << stateColours(rig).red;
  EXPECT_LT(stateColours(rig).yellow, NONE);
  GrabStatuses held;
  held.held.resize(1);  // the trunk of the only tree
  grabs.publish(held);
  EXPECT_TRUE(advanceUntil([&] { return stateColours(rig).yellow > 0.005; }))
      << stateColours(rig).yellow;
  EXPECT_GT(stateColours(rig).red, NONE);
  grabs.publish(GrabStatuses());
  EXPECT_TRUE(advanceUntil([&] { return stateColours(rig).yellow < NONE; }));
  rig.publishState(rig.now(), 0);
  EXPECT_TRUE(advanceUntil([&] { return stateColours(rig).red < NONE; })) << stateColours(rig).red;
}

TEST_F(ForestDisplayTest, EveryPropertyCanBeChanged) {
  ASSERT_TRUE(drawn());
  expectEveryPropertyCanBeChanged(rig, *display);
  rig.publishState();
  EXPECT_TRUE(drawn());
}

TEST_F(ForestDisplayTest, SettingsSurviveSaveAndLoad) {
  expectSettingsSurvive(rig, *display, [&] { return rig.addDisplay(); });
}

TEST_F(ForestDisplayTest, LeavesNothingBehind) {
  ASSERT_TRUE(drawn());
  rig.remove(display);
  display = nullptr;
  expectNothingLeftBehind(
      rig, [&] { return rig.addDisplay(); },
      [&](rviz::Display& another) {
        return static_cast<ForestDisplay&>(another).drawn().trees == TREES;
      });
}

TEST_F(ForestDisplayTest, StandsInAnyFixedFrame) {
  expectStandsInAnyFixedFrame(rig, *display);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forest_display_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
