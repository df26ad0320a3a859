// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Strips on the edges of tiles, and discs of colour at every level of detail.
#include <OgreCamera.h>
#include <OgreViewport.h>

#include <array>
#include <iostream>

#include "rviz/rigs/grass_display_fixture.h"

namespace vegetation_sim {
namespace {

// S2-18: a disc that colours the grass is visible in blades and in strips, which have no ground
// here, and in the texture of the ground alone, and it is gone with its message.
TEST_F(GrassDisplayTest, ShowsDiscsOfColourAtEveryLevel) {
  GrassColours dry;
  dry.header.frame_id = "map";
  dry.header.stamp.fromSec(rig.now());
  GrassColour disc;
  disc.radius = 9.0;
  disc.colour = 1.0;
  disc.weight = 50.0;
  for (const bool blades : {true, false})
    for (const bool strips : {true, false}) {
      display->subProp("Single Blades")->setValue(blades);
      display->subProp("Strips")->setValue(strips);
      display->subProp("Ground")->setValue(!blades && !strips);
      dry.colours.clear();
      rig.publish(dry);
      rig.publishMeadow(GrassRig::meadow(TILES), 0.0);
      rig.frames(60);
      const ImageStatistics before = rig.imageStatistics();
      dry.colours = {disc};
      rig.publish(dry);
      EXPECT_TRUE(rig.until([&] { return rig.imageStatistics().green < before.green - 0.1; }))
          << blades << strips << " green " << before.green << " and "
          << rig.imageStatistics().green;
    }
  display->subProp("Ground")->setValue(true);
  dry.colours.clear();
  rig.publish(dry);
}

// S2-10, S2-12, S2-14: strips on the edges of tiles, as paper 2 has them, or rows in them. The
// errors are those against a picture of single blades.
TEST_F(GrassDisplayTest, DrawsStripsOnEdgesOrInRows) {
  setCamera(0.2, 14.0);
  rig.publishMeadow(GrassRig::meadow(TILES), 0.0);
  display->subProp("Blades")->setValue(100000);
  display->subProp("Tolerance")->setValue(0.5);
  ASSERT_TRUE(rig.until([&] { return display->drawn().blades > 40000; }))
      << display->drawn().blades;
  rig.frames(60);
  const std::vector<std::uint8_t> blades = rig.picture();
  display->subProp("Single Blades")->setValue(false);
  display->subProp("Tolerance")->setValue(8.0);
  double error[2];
  std::size_t triangles[2];
  for (const bool edges : {false, true}) {
    display->subProp("Strips on Edges")->setValue(edges);
    ASSERT_TRUE(rig.until([&] { return display->drawn().stripped > 20; }));
    rig.frames(60);
    error[edges] = changed(blades);
    triangles[edges] = display->drawn().triangles;
    std::cout << (edges ? "edges" : "rows") << ": " << triangles[edges] << " triangles on "
              << display->drawn().stripped << " tiles, error " << error[edges] << " of 255\n";
  }
  // Of a tile that is seen from the side; layers alone are seen of those below the camera.
  constexpr std::size_t FEWER = 36 - 32;
  EXPECT_LE(triangles[0] - triangles[1], FEWER * display->drawn().stripped);
  EXPECT_GT(triangles[0] - triangles[1], FEWER * display->drawn().stripped * 9 / 10);
  display->subProp("Strips")->setValue(false);
  rig.frames(60);
  EXPECT_LT(error[0], changed(blades));
  EXPECT_LT(error[1], changed(blades));
}

// S2-19: the wind moves what is drawn at each level, with the clock and only with it.
TEST_F(GrassDisplayTest, TheWindMovesBladesRowsAndStripsOnEdges) {
  struct Level {
    const char* name;
    bool blades, edges;
  };
  for (const Level level :
       {Level{"blades", true, false}, Level{"rows", false, false}, Level{"edges", false, true}}) {
    display->subProp("Single Blades")->setValue(level.blades);
    display->subProp("Strips on Edges")->setValue(level.edges);
    ASSERT_TRUE(rig.until([&] {
      const view::GrassReport drawn = display->drawn();
      return level.blades ? drawn.blades > 0 : drawn.blades == 0 && drawn.stripped > 0;
    })) << level.name;
    rig.frames(60);
    const std::vector<std::uint8_t> before = rig.picture();
    rig.frames(10);
    EXPECT_EQ(rig.picture(), before) << level.name;
    rig.setTime(rig.now() + 0.5);
    EXPECT_TRUE(rig.until([&] { return changed(before) > 0.1; }))  // of 255; strips are few
        << level.name << ' ' << changed(before);
  }
}

// N7: frames that take longer than wanted have fewer blades, whatever takes the time.
TEST_F(GrassDisplayTest, DrawsFewerBladesWhileFramesTakeTooLong) {
  display->subProp("Blades")->setValue(20000);
  ASSERT_TRUE(settled());
  const std::size_t all = display->drawn().blades;
  display->subProp("Frame Time")->setValue(1.0);  // less than any frame takes
  EXPECT_TRUE(rig.until([&] {
    rig.setTime(rig.now() + 0.05);
    return display->drawn().blades < all / 3;
  })) << display->drawn().blades
      << " of " << all;
  display->subProp("Frame Time")->setValue(0.0);
  EXPECT_TRUE(rig.until([&] {
    rig.setTime(rig.now() + 0.05);
    return display->drawn().blades > 2 * all / 3;
  })) << display->drawn().blades
      << " of " << all;
}

// Shows few tiles of sparse blades, painted by level, so that most pixels of the meadow are ground.
void showSparseBlades(GrassRig& rig, GrassDisplay& display) {
  constexpr int FEW_TILES = 4;
  display.subProp("Colour by Level")->setValue(true);
  display.subProp("Tolerance")->setValue(2.0);
  display.subProp("Transition")->setValue(0.1);
  rig.lookAt(0.3f, 0.35, 9.0);
  grass::Layout sparse = GrassRig::meadow(FEW_TILES);
  grass::MapInput input = sparse.map->input();
  input.density.value = 60.0;
  input.species.resize(1);
  sparse.map = std::make_shared<const grass::FeatureMap>(input);
  rig.publishMeadow(sparse, 0.0);
  EXPECT_TRUE(rig.until([&] { return display.drawn().tiles == FEW_TILES * FEW_TILES; }));
}

// Returns which pixels show blades: they are red, and all else is not.
std::vector<bool> bladesIn(const std::vector<std::uint8_t>& picture) {
  std::vector<bool> out(picture.size() / 3);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int red = picture[3 * i], blue = picture[3 * i + 2];
    out[i] = red > 150 && red > blue + 100;
  }
  return out;
}

// Returns the share of the pixels of blades amid their transition to strips that showed blades at
// its begin, when these had their full width. The transition is slow while time passes, and then so
// fast that it stands in its middle.
double shareAtTheirPlaces(GrassRig& rig, GrassDisplay& display) {
  constexpr double PART = 0.6;  // of the transition
  const int before = display.drawn().rebuilds;
  display.subProp("Tolerance")->setValue(40.0);
  EXPECT_TRUE(rig.until([&] { return display.drawn().rebuilds > before; }));
  display.subProp("Transition")->setValue(60.0);
  const ros::WallTime begin = ros::WallTime::now();
  rig.frames(4);
  const std::vector<bool> wide = bladesIn(rig.picture());
  const auto passed = [&] { return (ros::WallTime::now() - begin).toSec(); };
  EXPECT_TRUE(rig.until([&] { return passed() > 4.0; }));
  display.subProp("Transition")->setValue(passed() / PART);
  rig.frames(3);
  const std::vector<bool> narrow = bladesIn(rig.picture());
  double all = 0.0, kept = 0.0;
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    all += narrow[i];
    kept += narrow[i] && wide[i];
  }
  std::cout << kept << " of " << all << " pixels of blades are where blades were\n";
  EXPECT_GT(display.drawn().stripped, 0u);
  EXPECT_GT(all, 100.0);
  return kept / all;
}

// Returns a meadow that is dense on the left of a view from the north-east and sparse on its right.
grass::Layout denseBesideSparse() {
  grass::Layout out = GrassRig::meadow(TILES);
  grass::MapInput input = out.map->input();
  input.species.resize(1);
  input.density.white = 500.0;
  input.density.image = {TILES + 1, TILES + 1, 16, {}};
  for (int row = 0; row <= TILES; ++row)
    for (int column = 0; column <= TILES; ++column)
      input.density.image.samples.push_back(row + column > TILES ? 16 : 1);
  out.map = std::make_shared<const grass::FeatureMap>(input);
  return out;
}

// Returns how many pixels of the left and the right half show grass that is painted by level.
std::array<double, 2> grassInHalves(GrassRig& rig) {
  const std::vector<std::uint8_t> picture = rig.picture();
  const auto width = static_cast<std::size_t>(rig.camera().getViewport()->getActualWidth());
  std::array<double, 2> out{};
  for (std::size_t i = 0; i < picture.size() / 3; ++i) {
    const int red = picture[3 * i], green = picture[3 * i + 1], blue = picture[3 * i + 2];
    out[2 * (i % width) / width] += std::max(red, blue) > green + 40;
  }
  return out;
}

// S2-10: where few blades grow, strips hide no more of the ground than single blades do.
TEST_F(GrassDisplayTest, SparseStripsShowTheGroundBehindThem) {
  setCamera(0.2, 14.0);
  display->subProp("Colour by Level")->setValue(true);
  display->subProp("Transition")->setValue(0.0);
  rig.publishMeadow(denseBesideSparse(), 0.0);
  double sparse_blades = 0.0;
  for (const char* level : {"blades", "rows", "edges"}) {
    const bool blades = level == std::string("blades");
    display->subProp("Single Blades")->setValue(blades);
    display->subProp("Strips")->setValue(!blades);
    display->subProp("Strips on Edges")->setValue(level == std::string("edges"));
    display->subProp("Tolerance")->setValue(blades ? 0.5 : 8.0);
    rig.frames(60);
    const auto [dense, sparse] = grassInHalves(rig);
    std::cout << level << ": " << dense << " pixels of dense grass, " << sparse << " of sparse\n";
    if (blades) sparse_blades = sparse;
    EXPECT_GT(sparse, 100.0) << level;
    EXPECT_LE(sparse, sparse_blades) << level;
  }
}

// Returns the mean length of the horizontal runs of pixels that show blades [pixel].
double runsOfBlades(GrassRig& rig) {
  const std::vector<bool> blades = bladesIn(rig.picture());
  const auto width = static_cast<std::size_t>(rig.camera().getViewport()->getActualWidth());
  double pixels = 0.0, runs = 0.0;
  for (std::size_t i = 0; i < blades.size(); ++i) {
    pixels += blades[i];
    runs += blades[i] && (i % width == 0 || !blades[i - 1]);
  }
  return runs > 0.0 ? pixels / runs : 0.0;
}

// S2-15: where few of the blades are drawn these are not broad, for strips stand among them.
TEST_F(GrassDisplayTest, FewBladesAreNotBroad) {
  setCamera(0.15, 8.0);
  display->subProp("Colour by Level")->setValue(true);
  display->subProp("Transition")->setValue(0.0);
  display->subProp("Blades")->setValue(3000);
  rig.publishMeadow(GrassRig::meadow(TILES), 0.0);
  double runs[2];
  for (const bool strips : {false, true}) {
    display->subProp("Strips")->setValue(strips);
    ASSERT_TRUE(settled());
    rig.frames(60);
    runs[strips] = runsOfBlades(rig);
  }
  std::cout << "blades: runs of " << runs[0] << " pixels without strips, " << runs[1]
            << " with strips\n";
  EXPECT_GT(runs[1], 0.0);
  EXPECT_LT(runs[1], 0.7 * runs[0]);
}

// S2-12: where rows take over, blades become narrower at their places.
TEST_F(GrassDisplayTest, BladesKeepTheirPlacesBetweenRows) {
  showSparseBlades(rig, *display);
  ASSERT_TRUE(settled());
  EXPECT_GT(shareAtTheirPlaces(rig, *display), 0.6);
}

// S2-12: while blades give way to strips on edges, they move there, and the picture has no jump.
TEST_F(GrassDisplayTest, BladesSlideToTheStripsOnEdges) {
  display->subProp("Strips on Edges")->setValue(true);
  display->subProp("Transition")->setValue(2.0);
  setCamera(0.25, 10.0);
  rig.publishMeadow(GrassRig::meadow(TILES), 0.0);
  ASSERT_TRUE(settled());
  const std::vector<std::uint8_t> before = rig.picture();
  display->subProp("Tolerance")->setValue(40.0);
  std::vector<std::uint8_t> last = before;
  double step = 0.0, frame = rig.frameCount();
  ASSERT_TRUE(rig.until([&] {
    rig.frames(1);
    const std::vector<std::uint8_t> next = rig.picture();
    step = std::max(step, difference(last, next) / (rig.frameCount() - frame));
    frame = rig.frameCount();
    last = next;
    return display->drawn().blades == 0;
  }));
  const double all = difference(before, last);
  std::cout << "change from blades to strips: " << all << " of 255, largest step " << step << "\n";
  EXPECT_GT(all, 1.0);
  EXPECT_LT(step, 0.5 * all);
  showSparseBlades(rig, *display);
  ASSERT_TRUE(settled());
  EXPECT_LT(shareAtTheirPlaces(rig, *display), 0.45);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "grass_levels_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
