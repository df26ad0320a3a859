// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "rviz/rigs/display_checks.h"
#include "rviz/wind/wind_display.h"
#include "scenes/forest/forest_fixture.h"
#include "vegetation_sim/ros/conversions/wind_conversions.h"

namespace vegetation_sim {
namespace {

class WindRig : public ViewRig {
 public:
  WindRig() { startNode(); }

  /// Starts a node that publishes the wind. A node that already runs is stopped.
  void startNode() {
    wind_.shutdown();
    wind_ = nh_.advertise<WindField>("wind", 10, true);
  }

  WindDisplay* addDisplay() { return add<WindDisplay>("vegetation_sim/WindDisplay"); }

  /// Returns a breeze and a disc.
  static WindField windy() {
    wind::Primitive disk;
    disk.id = 2;
    disk.name = "disk";
    disk.kind = wind::Kind::DISK;
    return toMsg(wind::Field({forest::makeBreeze(1, Vec3(6.0, 1.0, 0.0)), disk}), "map", 0);
  }
  void publish(const WindField& message) { wind_.publish(message); }

 private:
  ros::Publisher wind_;
};

// rviz can be started only once in a process, so all tests share one rig. Each test has its own
// display.
std::unique_ptr<WindRig> shared_rig;

class WindDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<WindRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override {
    rig.setTime(rig.now() + 10.0);
    rig.publish(WindRig::windy());
    display = rig.addDisplay();
    ASSERT_NE(display, nullptr) << "the plugin is not found or is another class";
    rig.lookAt(0.8f, 0.5, 20.0);
    ASSERT_TRUE(rig.until([&] { return display->drawn().arrows > 0; }));
  }
  void TearDown() override {
    if (display != nullptr) rig.remove(display);
  }

  WindRig& rig{*shared_rig};
  WindDisplay* display{nullptr};
};

// N2: arrows show the wind, and lines the outline of the disc.
TEST_F(WindDisplayTest, DrawsArrowsAndShapes) {
  EXPECT_EQ(display->drawn().shapes, 1u);
  EXPECT_GT(display->drawn().arrows, 300u);
  rig.frames(2);
  const std::vector<std::uint8_t> with = rig.picture();
  display->subProp("Arrows")->setValue(false);
  display->subProp("Shapes")->setValue(false);
  ASSERT_TRUE(rig.until([&] { return display->drawn().arrows + display->drawn().shapes == 0; }));
  rig.frames(2);
  EXPECT_GT(difference(with, rig.picture()), 1.0);
}

double shareOfRed(WindRig& rig) {
  const std::vector<std::uint8_t> pixels = rig.picture();
  double out = 0.0;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3) {
    const int red = pixels[i], other = std::max(pixels[i + 1], pixels[i + 2]);
    out += red > 100 && 2 * red > 5 * other ? 1.0 : 0.0;
  }
  return 3.0 * out / static_cast<double>(pixels.size());
}

// P1, figure 4: the disc is red if that is asked for, and otherwise has the colour of its speed.
TEST_F(WindDisplayTest, DiscsAreRedByAProperty) {
  display->subProp("Arrows")->setValue(false);
  ASSERT_TRUE(rig.until([&] { return display->drawn().arrows == 0; }));
  rig.frames(2);
  EXPECT_LT(shareOfRed(rig), 0.0005);
  display->subProp("Red Discs")->setValue(true);
  EXPECT_TRUE(rig.until([&] { return shareOfRed(rig) > 0.002; })) << shareOfRed(rig);
  display->subProp("Red Discs")->setValue(false);
  EXPECT_TRUE(rig.until([&] { return shareOfRed(rig) < 0.0005; })) << shareOfRed(rig);
}

TEST_F(WindDisplayTest, MovesWithTheClockAlone) {
  rig.frames(3);
  const std::vector<std::uint8_t> before = rig.picture();
  rig.frames(10);
  EXPECT_EQ(rig.picture(), before);
  rig.setTime(rig.now() + 1.0);
  EXPECT_TRUE(rig.until([&] { return difference(before, rig.picture()) > 0.1; }));
}

TEST_F(WindDisplayTest, RejectsInvalidNumbersAndKeepsItsState) {
  WindField bad = WindRig::windy();
  bad.primitives[0].velocity.x = std::numeric_limits<double>::quiet_NaN();
  rig.publish(bad);
  EXPECT_TRUE(rig.until([&] { return statusOf(*display, "Wind").rfind("Rejected", 0) == 0; }));
  EXPECT_GT(display->drawn().arrows, 0u);
}

TEST_F(WindDisplayTest, SurvivesTimeGoingBack) {
  rig.setTime(rig.now() - 50.0);
  rig.frames(5);
  EXPECT_GT(display->drawn().arrows, 0u);
}

TEST_F(WindDisplayTest, FollowsANodeThatDiesAndReturns) {
  expectReloadsAreFollowed(
      rig,
      [&](int scene) {
        rig.startNode();
        WindField wind = WindRig::windy();
        if (scene == 1) wind = toMsg(wind::Field(), "map", 0);
        for (int i = 0; i < 100; ++i) rig.publish(wind);
      },
      [&](int scene) {
        rig.setTime(rig.now() + 0.01);
        return display->drawn().shapes == (scene == 0 ? 1u : 0u) &&
               statusOf(*display, "Wind") == std::to_string(scene == 0 ? 2 : 0) + " primitives";
      });
}

TEST_F(WindDisplayTest, EveryPropertyCanBeChanged) {
  expectEveryPropertyCanBeChanged(rig, *display);
  EXPECT_TRUE(rig.until([&] { return display->drawn().arrows > 0; }));
}

TEST_F(WindDisplayTest, SettingsSurviveSaveAndLoad) {
  expectSettingsSurvive(rig, *display, [&] { return rig.addDisplay(); });
}

TEST_F(WindDisplayTest, LeavesNothingBehind) {
  rig.remove(display);
  display = nullptr;
  expectNothingLeftBehind(
      rig, [&] { return rig.addDisplay(); },
      [&](rviz::Display& another) {
        return static_cast<WindDisplay&>(another).drawn().arrows > 0;
      });
}

TEST_F(WindDisplayTest, StandsInAnyFixedFrame) {
  expectStandsInAnyFixedFrame(rig, *display);
}

// A display that fails to draw, because memory is short for example.
class FailingDisplay : public WindDisplay {
 public:
  bool fails{true};

 protected:
  void draw(Nanoseconds stamp, const view::View& view) override {
    if (fails) throw std::runtime_error("no room for arrows");
    WindDisplay::draw(stamp, view);
  }
};

TEST_F(WindDisplayTest, AFaultInDrawingIsShownAndDoesNotEndRviz) {
  auto* const failing = new FailingDisplay;  // the manager owns it
  failing->setName("failing");
  rig.manager().addDisplay(failing, true);
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*failing, "Drawn") == "Not drawn: no room for arrows";
  })) << statusOf(*failing, "Drawn");
  failing->fails = false;
  EXPECT_TRUE(rig.until([&] { return failing->drawn().arrows > 0; }));
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*failing, "Drawn").find("Not drawn") == std::string::npos;
  })) << statusOf(*failing, "Drawn");
  rig.remove(failing);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "wind_display_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
