// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rviz/view_controller.h>

#include <cmath>
#include <limits>

#include "rviz/forest/forest_display.h"
#include "rviz/rigs/display_checks.h"
#include "rviz/rigs/grass_display_fixture.h"
#include "vegetation_sim/ros/conversions/forest_conversions.h"

namespace vegetation_sim {
namespace {

// S2-05, S2-13: blades, strips beyond them and a ground without holes are visible.
TEST_F(GrassDisplayTest, DrawsAMeadowWithGroundAndSky) {
  setCamera(0.25, 12.0);
  display->subProp("Blades")->setValue(3000);
  ASSERT_TRUE(settled());
  EXPECT_GT(display->drawn().bladed, 0u);
  EXPECT_GT(display->drawn().stripped, 0u);
  const ImageStatistics seen = rig.imageStatistics();
  EXPECT_GT(seen.green, 0.3);
  EXPECT_GT(seen.blue, 0.05);
  EXPECT_GT(seen.spread, 15.0);
}

// S2-17: the wind moves the grass with the clock, and only with it.
TEST_F(GrassDisplayTest, MovesWithTheClockAlone) {
  ASSERT_TRUE(settled());
  const std::vector<std::uint8_t> before = rig.picture();
  rig.frames(10);
  EXPECT_EQ(rig.picture(), before);
  rig.setTime(rig.now() + 0.5);
  EXPECT_TRUE(rig.until([&] { return changed(before) > 0.5; }));
}

// S2-21: a track is visible among blades, among strips and in the texture of the ground alone.
TEST_F(GrassDisplayTest, ShowsTracksAtEveryLevel) {
  struct Level {
    bool blades, strips;
  };
  for (const Level level : {Level{true, true}, Level{false, true}, Level{false, false}}) {
    display->subProp("Single Blades")->setValue(level.blades);
    display->subProp("Strips")->setValue(level.strips);
    rig.publishMeadow(GrassRig::meadow(TILES), 0.0);
    ASSERT_TRUE(rig.until([&] { return display->drawn().trodden == 0; }));
    rig.frames(40);
    const std::vector<std::uint8_t> before = rig.picture();
    rig.tread({-4.0, 0.0}, {4.0, 0.0});
    ASSERT_TRUE(rig.until([&] { return display->paintedTracks() > 3; }));
    ASSERT_TRUE(rig.until([&] { return display->drawn().trodden > 0; }));
    rig.frames(10);
    EXPECT_GT(changed(before), 0.4) << level.blades << level.strips;
  }
}

// S2-28: tracks disappear while the grass rises.
TEST_F(GrassDisplayTest, TracksGoWhenTheGrassHasRisen) {
  ASSERT_TRUE(settled());
  rig.tread({-4.0, 0.0}, {4.0, 0.0}, 5.0);
  ASSERT_TRUE(rig.until([&] { return display->paintedTracks() > 3; }));
  EXPECT_TRUE(rig.until([&] {
    rig.setTime(rig.now() + 0.1);
    return display->drawn().trodden == 0 && display->paintedTracks() == 0;
  }));
}

// S2-15: fewer blades or a larger distance make a coarser image, never above the limit.
TEST_F(GrassDisplayTest, KeepsToTheBlades) {
  for (const int most : {20000, 4000}) {
    display->subProp("Blades")->setValue(most);
    EXPECT_TRUE(rig.until([&] {
      return display->drawn().blades > 0 &&
             display->drawn().blades < 1.15 * static_cast<double>(most);
    })) << display->drawn().blades;
  }
  setCamera(0.3, 300.0);
  EXPECT_TRUE(rig.until([&] { return display->drawn().blades == 0; }));
}

// S2-15: after a step back only levels change, and no two successive images show much of it.
TEST_F(GrassDisplayTest, LevelsFadeIntoOneAnother) {
  setCamera(0.25, 8.0);
  display->subProp("Blades")->setValue(3000);
  ASSERT_TRUE(settled());
  const int rebuilds = display->drawn().rebuilds;
  setCamera(0.25, 14.0);
  ASSERT_TRUE(rig.until([&] { return display->drawn().rebuilds > rebuilds; }));
  rig.frames(1);
  const std::vector<std::uint8_t> before = rig.picture();
  std::vector<std::uint8_t> last = before;
  double step = 0.0, frame = rig.frameCount();
  int same = 0;
  ASSERT_TRUE(rig.until([&] {
    rig.frames(1);
    const std::vector<std::uint8_t> next = rig.picture();
    const double frames = rig.frameCount() - frame;  // A busy machine may draw two frames at once.
    step = std::max(step, rig.largestChange(last, next) / frames);
    frame += frames;
    same = next == last ? same + 1 : 0;
    last = next;
    return same > 20;
  }));
  const double all = rig.largestChange(before, last);
  std::cout << "largest change of a block: " << all << " of 255, between two pictures " << step
            << "\n";
  EXPECT_GT(all, 8.0);
  EXPECT_LT(step, 0.45 * all);
}

// Once tracks near listeners are published, only these are received, and drawn where they appear.
TEST_F(GrassDisplayTest, ReadsTheTracksNearIt) {
  ASSERT_TRUE(settled());
  rig.tread({-4.0, 0.0}, {4.0, 0.0});
  ASSERT_TRUE(rig.until([&] { return display->drawn().trodden > 0; }));
  EXPECT_EQ(rig.readersOfAll(), 1U);
  rig.publishNear({-1000.0, 0.0}, 100.0);
  EXPECT_TRUE(rig.until([&] { return display->drawn().trodden == 0 && rig.readersOfAll() == 0; }));
  rig.publishNear({0.0, 0.0}, 100.0);
  EXPECT_TRUE(
      rig.until([&] { return display->drawn().trodden > 0 && display->paintedTracks() > 3; }));
  rig.stopNear();  // for the tests that follow
  EXPECT_TRUE(rig.until([&] { return rig.readersOfAll() == 1; }));
}

TEST_F(GrassDisplayTest, SurvivesTimeGoingBack) {
  ASSERT_TRUE(settled());
  rig.tread({-4.0, 0.0}, {4.0, 0.0});
  ASSERT_TRUE(rig.until([&] { return display->drawn().trodden > 0; }));
  rig.setTime(rig.now() - 50.0);
  rig.publishMeadow(GrassRig::meadow(TILES));  // The node does the same.
  EXPECT_TRUE(
      rig.until([&] { return display->drawn().tiles > 0 && display->drawn().trodden == 0; }));
  rig.tread({-4.0, 1.0}, {4.0, 1.0});
  EXPECT_TRUE(rig.until([&] { return display->drawn().trodden > 0; }));
}

TEST_F(GrassDisplayTest, RejectsInvalidMessagesAndKeepsItsState) {
  ASSERT_TRUE(settled());
  GrassLayout layout = toMsg(GrassRig::meadow(4));
  layout.header.frame_id = "map";
  layout.density.value = std::numeric_limits<double>::quiet_NaN();
  rig.publish(layout);
  WindField wind = toMsg(wind::Field({forest::makeBreeze(1, Vec3(3.0, 0.0, 0.0))}), "map", 0);
  wind.primitives[0].velocity.x = std::numeric_limits<double>::infinity();
  rig.publish(wind);
  GrassState unknown;
  unknown.header.stamp.fromSec(rig.now());
  unknown.key_frame = true;
  unknown.layout_hash = 12345;
  rig.publish(unknown);
  EXPECT_TRUE(rig.until([&] {
    return status("Layout").rfind("Rejected", 0) == 0 && status("Wind").rfind("Rejected", 0) == 0 &&
           status("State").find("layout") != std::string::npos;
  })) << status("Layout")
      << "; " << status("Wind") << "; " << status("State");
  unknown.press_stamps.resize(1);
  unknown.press_recoveries = {std::numeric_limits<float>::quiet_NaN()};
  rig.publish(unknown);
  EXPECT_TRUE(rig.until([&] { return status("State").rfind("Rejected", 0) == 0; }))
      << status("State");
  EXPECT_EQ(display->drawn().tiles, static_cast<std::size_t>(TILES) * TILES);
}

TEST_F(GrassDisplayTest, FollowsALayoutThatChanges) {
  ASSERT_TRUE(drawn());
  rig.publishMeadow(GrassRig::meadow(6));
  EXPECT_TRUE(rig.until([&] { return display->drawn().tiles == 36; }));
}

TEST_F(GrassDisplayTest, ReportsMissingStates) {
  ASSERT_TRUE(drawn());
  expectSilenceIsReported(rig, *display, [&] { rig.publishState(); });
}

TEST_F(GrassDisplayTest, FollowsANodeThatDiesAndReturns) {
  ASSERT_TRUE(drawn());
  expectReloadsAreFollowed(
      rig,
      [&](int scene) {
        rig.startNode();
        rig.publishMeadow(GrassRig::meadow(scene == 0 ? 6 : 4));
        for (int i = 0; i < 100; ++i) rig.publishState();
      },
      [&](int scene) { return display->drawn().tiles == (scene == 0 ? 36u : 16u); });
}

// N7
TEST_F(GrassDisplayTest, ShowsTheGovernorsChoice) {
  ASSERT_TRUE(drawn());
  expectAllocationIsReported(rig, *display, "grass_field", "Cost [blades]", "Budget [blades]",
                             "blades");
}

TEST_F(GrassDisplayTest, EveryPropertyCanBeChanged) {
  ASSERT_TRUE(drawn());
  expectEveryPropertyCanBeChanged(rig, *display);
  EXPECT_TRUE(drawn());
}

TEST_F(GrassDisplayTest, SettingsSurviveSaveAndLoad) {
  expectSettingsSurvive(rig, *display, [&] { return rig.addDisplay(); });
}

// A node without a meadow publishes a layout without grass; a display with more information draws
// the ground.
TEST_F(GrassDisplayTest, ABareMeadowLeavesTheGroundToOtherDisplays) {
  ASSERT_TRUE(drawn());
  auto* forest = rig.add<ForestDisplay>("vegetation_sim/ForestDisplay");
  ASSERT_NE(forest, nullptr);
  ros::Publisher trees = rig.nodeHandle().advertise<ForestLayout>("forest/layout", 1, true);
  ForestLayout message = toMsg(forest::gridLayout(1, 2.0));
  message.header.frame_id = "map";
  trees.publish(message);
  const auto byAnother = [](rviz::Display& display) {
    return statusOf(display, "Scenery").find("ground by") != std::string::npos;
  };
  EXPECT_TRUE(rig.until([&] { return byAnother(*forest) && !byAnother(*display); }));
  grass::Layout bare = GrassRig::meadow(TILES);
  grass::MapInput input;
  input.law = bare.map->law();
  input.density.value = 0.0;
  bare.map = std::make_shared<const grass::FeatureMap>(input);
  rig.publishMeadow(bare);
  EXPECT_TRUE(rig.until([&] { return byAnother(*display) && !byAnother(*forest); }));
  rig.publishMeadow(GrassRig::meadow(TILES));
  EXPECT_TRUE(rig.until([&] { return byAnother(*forest) && !byAnother(*display); }));
  rig.remove(forest);
}

// There are more tiles than a texture has pixels: the display draws no ground and does not stall.
TEST_F(GrassDisplayTest, AMeadowTooLongForATextureHasNoGround) {
  ASSERT_TRUE(drawn());
  grass::MapInput input;
  input.law = GrassRig::meadow(2).map->law();
  input.law.columns = 8192;
  input.density.value = 500.0;
  grass::Layout strip = GrassRig::meadow(2);
  strip.map = std::make_shared<const grass::FeatureMap>(input);
  rig.publishMeadow(strip);
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*display, "Drawn").find("no ground: more than 2048") != std::string::npos;
  })) << statusOf(*display, "Drawn");
}

TEST_F(GrassDisplayTest, LeavesNothingBehind) {
  ASSERT_TRUE(drawn());
  rig.remove(display);
  display = nullptr;
  expectNothingLeftBehind(
      rig, [&] { return rig.addDisplay(); },
      [&](rviz::Display& another) {
        return static_cast<GrassDisplay&>(another).drawn().blades > 0;
      });
}

TEST_F(GrassDisplayTest, StandsInAnyFixedFrame) {
  expectStandsInAnyFixedFrame(rig, *display);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "grass_display_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
