// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Layers of leaves that are drawn as pictures.
#include <OgreCamera.h>
#include <OgreViewport.h>

#include <array>
#include <cmath>
#include <iostream>

#include "rviz/rigs/canopy_display_fixture.h"

namespace vegetation_sim {
namespace {

/// Returns a red plant straight in front of a green one, seen by rig.lookAt(3.5, 0, 12), in layers
/// that are cut for this view, or for one from the other side. Neither has any blue.
canopy::Layout redInFrontOfGreen(bool turned) {
  const double yaw = 0.8;  // of the view
  const Vec3 to_eye(std::cos(yaw), std::sin(yaw), 0.0);
  canopy::Layout out = CanopyRig::shrubs(2);
  out.motion.plane.camera = (turned ? -12.0 : 12.0) * to_eye;
  out.motion.plane.yaw = turned ? yaw : yaw + M_PI;
  out.motion.cuts.near_layers = out.motion.cuts.far_layers = 1;
  out.motion.cuts.near_end = out.motion.cuts.mid_end = 11.5;
  const auto leafyKind = [&](const char* name, int leaves, double radius, double leaf,
                             const Vec3& colour) {
    canopy::PlantKind kind = out.kinds[0];
    kind.name = name;
    kind.stems = 0;
    kind.leaves = leaves;
    kind.height = 2.0 * radius;
    kind.radius = radius;
    kind.leaf_length = leaf;
    kind.leaf_width = 0.5 * leaf;
    kind.colour = kind.colour_young = colour;
    return kind;
  };
  out.kinds = {leafyKind("red", 5000, 1.5, 0.08, Vec3(0.8, 0.0, 0.0)),
               leafyKind("green", 20000, 4.0, 0.4, Vec3(0.0, 0.8, 0.0))};
  out.plants[0].position = 3.0 * to_eye + Vec3(0.0, 0.0, 2.0);
  out.plants[1].position = -4.0 * to_eye;
  return out;
}

class CanopyPicturesTest : public CanopyDisplayTest {
 protected:
  /// Shows a bank of shrubs with many leaves in each layer, from the front, leaf by leaf.
  void showBank() {
    canopy::Layout bank = CanopyRig::shrubs(0);
    bank.kinds[0].leaves = 1000;
    bank.motion.cuts.near_layers = 3;
    bank.motion.cuts.near_end = bank.motion.cuts.mid_end = 100.0;
    for (int i = 0; i < 24; ++i) {
      canopy::Plant plant;
      plant.seed = static_cast<std::uint64_t>(i) + 1;
      plant.position = Vec3(1.6 * (i % 4), 1.5 * (i / 4) - 3.75, 0.0);
      bank.plants.push_back(plant);
    }
    rig.plant(bank);
    rig.lookAt(0.8f, 0.2, 16.0);
    rig.blow(1);
    ASSERT_TRUE(rig.until([&] { return display->drawn().plants == 24; }));
    display->subProp("Tolerance")->setValue(0.1);  // every leaf
    setTolerance(0.0);
  }
  /// Returns what is seen with every leaf on its own, or with pictures of all layers.
  std::vector<std::uint8_t> seen(double tolerance) {
    setTolerance(tolerance);
    EXPECT_TRUE(rig.until([&] {
      const view::CanopyReport drawn = display->drawn();
      return tolerance > 0.0 ? drawn.pictures == drawn.layers && drawn.drawn == 0
                             : drawn.pictures == 0 && drawn.drawn == drawn.leaves;
    })) << display->drawn().pictures
        << " pictures of " << display->drawn().layers << " layers, " << display->drawn().drawn
        << " leaves, renderings " << display->drawn().renderings;
    return steadyPicture(rig);
  }
  /// Returns the shares of red pixels and of pixels with blue in the middle of a picture.
  std::array<double, 2> redAndBlueIn(const std::vector<std::uint8_t>& picture) {
    const auto width = static_cast<std::size_t>(rig.camera().getViewport()->getActualWidth());
    const std::size_t rows = picture.size() / 3 / width;
    double count = 0.0, red = 0.0, blue = 0.0;
    for (std::size_t row = rows / 3; row < 2 * rows / 3; ++row)
      for (std::size_t column = 3 * width / 8; column < 5 * width / 8; ++column) {
        const std::uint8_t* pixel = &picture[3 * (row * width + column)];
        count += 1.0;
        red += pixel[0] > pixel[1];
        blue += pixel[2] > 50;
      }
    return {red / count, blue / count};
  }
  /// Compares pictures of a red plant in front of a green one with single leaves.
  void expectNoFringe(bool turned) {
    rig.plant(redInFrontOfGreen(turned));
    rig.lookAt(3.5f, 0.0, 12.0);
    rig.blow(60);  // leaves between pixels have edges that are partly transparent
    ASSERT_TRUE(rig.until([&] { return display->drawn().plants == 2; }));
    display->subProp("Tolerance")->setValue(0.1);  // every leaf
    const std::array<double, 2> leaves = redAndBlueIn(seen(0.0)),
                                pictures = redAndBlueIn(seen(100.0));
    EXPECT_EQ(display->drawn().pictures, 2);
    std::cout << "red and blue: leaves " << leaves[0] << ", " << leaves[1] << ", pictures "
              << pictures[0] << ", " << pictures[1] << "\n";
    EXPECT_NEAR(pictures[0], leaves[0], 0.1);
    EXPECT_LT(pictures[1], leaves[1] + 0.02);
  }
};

// S3-07, S3-27: the pictures show the same plants as every leaf on its own, at rest and in wind.
TEST_F(CanopyPicturesTest, PicturesLookLikeTheirLeaves) {
  showBank();
  const std::vector<std::uint8_t> leaves = seen(0.0), pictures = seen(100.0);
  rig.blow(80);
  const std::vector<std::uint8_t> moved_leaves = seen(0.0), moved_pictures = seen(100.0);
  const double motion = difference(leaves, moved_leaves);
  EXPECT_LT(difference(leaves, pictures), 0.5 * motion);
  EXPECT_LT(difference(moved_leaves, moved_pictures), motion);
  EXPECT_NEAR(difference(pictures, moved_pictures), motion, 0.3 * motion);
}

// S3-07: pictures are composed from back to front. In front of a green plant leaves of a red one
// have no fringe of sky, whatever view the layers are cut for.
TEST_F(CanopyPicturesTest, PicturesAreComposedFromBackToFront) {
  expectNoFringe(false);
}

TEST_F(CanopyPicturesTest, PicturesAreComposedFromBackToFrontInLayersOfAnotherView) {
  expectNoFringe(true);
}

// S3-28, S3-W7: pictures stay on the graphics card: moving renders no leaves, another eye does.
TEST_F(CanopyPicturesTest, PicturesAreRenderedAgainOnlyForAnotherEye) {
  showBank();
  seen(100.0);
  const int renderings = display->drawn().renderings;
  rig.blow(40);
  rig.frames(5);
  EXPECT_EQ(display->drawn().renderings, renderings);
  rig.lookAt(0.8f, 0.9, 16.0);
  EXPECT_TRUE(rig.until([&] { return display->drawn().renderings > renderings; }));
}

// A picture whose predicted error is too large is not used, nor one of a layer with few leaves.
TEST_F(CanopyPicturesTest, PicturesAreUsedOnlyWhereTheyAreGoodAndWorthwhile) {
  showBank();
  rig.blow(40);
  seen(100.0);
  setTolerance(0.001);
  EXPECT_TRUE(rig.until([&] {
    return display->drawn().pictures == 0 && display->drawn().drawn == display->drawn().leaves;
  })) << display->drawn().pictures;
  setTolerance(100.0);
  rig.plant(4);
  rig.blow(1);
  ASSERT_TRUE(rig.until([&] { return display->drawn().plants == 4; }));
  rig.frames(10);
  EXPECT_EQ(display->drawn().pictures, 0);
}

// Plants that bodies push, and those that are cut, are seen as they are.
TEST_F(CanopyPicturesTest, PicturesShowPlantsThatArePushedOrCut) {
  showBank();
  const std::vector<std::uint8_t> upright = seen(100.0);
  rig.pushApart();
  EXPECT_TRUE(rig.until([&] { return difference(upright, rig.picture()) > 1.0; }));
  EXPECT_EQ(display->drawn().pictures, 0);
  rig.publish(rig.message());
  EXPECT_TRUE(rig.until([&] { return difference(upright, rig.picture()) < 0.1; }));
  rig.cut({0, 1, 2, 3}, 0.4);
  EXPECT_TRUE(rig.until([&] { return difference(upright, rig.picture()) > 0.3; }));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "canopy_pictures_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
