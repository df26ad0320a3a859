// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <ros/param.h>
#include <unistd.h>

#include <QImage>
#include <filesystem>
#include <fstream>
#include <limits>

#include "ros/params/plant_files.h"
#include "rviz/rigs/canopy_display_fixture.h"
#include "rviz/rigs/shade.h"
#include "rviz/trees/shared_light.h"

namespace vegetation_sim {
namespace {

/// A folder with a mesh of one card, 1 m wide and 2 m high, which a scene may name.
class CardFolder {
 public:
  CardFolder() {
    std::filesystem::create_directories(folder_);
    ros::param::set("/resource_folders", std::vector<std::string>{folder_.string()});
    std::ofstream(folder_ / "card.obj")
        << "mtllib card.mtl\nv -0.5 0 0\nv 0.5 0 0\nv 0.5 0 2\nv -0.5 0 2\nvt 0 0\nvt 1 0\n"
           "vt 1 1\nvt 0 1\nvn 0 -1 0\nusemtl leaf\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n";
    std::ofstream(folder_ / "card.mtl") << "newmtl leaf\nKd 1 1 1\nmap_Kd leaf.png\n";
  }
  ~CardFolder() {
    ros::param::del("/resource_folders");
    std::filesystem::remove_all(folder_);
  }
  /// Paints the texture: the upper half red, the lower half transparent.
  void paint() const {
    QImage image(64, 64, QImage::Format_ARGB32);
    image.fill(qRgba(0, 0, 255, 0));
    for (int row = 0; row < 32; ++row)
      for (int column = 0; column < 64; ++column)
        image.setPixel(column, row, qRgba(255, 0, 0, 255));
    image.save(QString::fromStdString((folder_ / "leaf.png").string()));
  }
  void damage() const { std::ofstream(folder_ / "leaf.png") << "no picture"; }
  canopy::Layout layout() const {
    canopy::Layout out = CanopyRig::shrubs(1);
    out.kinds[0].shape = canopy::PlantShape::MESH;
    out.kinds[0].file = (folder_ / "card.obj").string();
    out.kinds[0].height = 2.0;
    out.plants[0].position = Vec3::Zero();
    Faults faults;
    loadForms(out, folder_.string(), faults);
    EXPECT_TRUE(faults.empty()) << faults.text();
    return out;
  }

 private:
  std::filesystem::path folder_{std::filesystem::temp_directory_path() /
                                ("card_" + std::to_string(::getpid()))};
};

/// A cloud of slices above the ground.
canopy::Layout cloudOf(canopy::CellLook look) {
  canopy::Layout out = CanopyRig::shrubs(1);
  canopy::PlantKind& kind = out.kinds[0];
  kind.shape = canopy::PlantShape::SLICES;
  kind.look = look;
  kind.file = "package://vegetation_sim/media/plants/cloud_00.png";
  kind.height = 4.4;
  kind.solid = 0.3;
  out.plants[0].position = Vec3(0.0, 0.0, 5.0);
  Faults faults;
  loadForms(out, "", faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  return out;
}

double shareOfRed(CanopyRig& rig) {
  const std::vector<std::uint8_t> pixels = rig.picture();
  double out = 0.0;
  for (std::size_t i = 0; i + 2 < pixels.size(); i += 3)
    out += pixels[i] > 3 * pixels[i + 1] && pixels[i] > 3 * pixels[i + 2] ? 1.0 : 0.0;
  return 3.0 * out / static_cast<double>(pixels.size());
}

// S3-29: a mesh is drawn with its texture and what is transparent in it; a damaged texture is named
// and the mesh is plain.
TEST_F(CanopyDisplayTest, MeshesHaveTheirTextures) {
  const CardFolder folder;
  folder.paint();
  rig.plant(folder.layout());
  rig.lookAt(1.0f, 0.1, 5.0);
  rig.blow(1);
  ASSERT_TRUE(rig.until([&] { return display->drawn().plants == 1; }));
  rig.frames(5);
  const double half = shareOfRed(rig);
  EXPECT_GT(half, 0.01);
  folder.damage();
  rig.plant(folder.layout());
  rig.blow(1);
  ASSERT_TRUE(rig.until([&] { return shareOfRed(rig) < 0.001; }));
  EXPECT_EQ(display->drawn().drawn, 2u);
  EXPECT_TRUE(rig.until([&] {
    const std::string text = statusOf(*display, "Textures");
    return text.find("texture 'leaf.png' is no picture of a known format") != std::string::npos;
  })) << statusOf(*display, "Textures");
}

// S3-W6: cells of slices are drawn as leaves or as puffs. The camera is below the cloud.
TEST_F(CanopyDisplayTest, SlicesLookLikeLeavesOrPuffs) {
  rig.lookAt(7.f, -0.4, 12.0);
  setTolerance(0.0);  // no pictures of layers
  std::vector<std::vector<std::uint8_t>> seen;
  for (const canopy::CellLook look : {canopy::CellLook::LEAVES, canopy::CellLook::PUFFS}) {
    rig.plant(4);  // other plants, so that the cloud is known to be the new one
    ASSERT_TRUE(rig.until([&] { return display->drawn().plants == 4; }));
    if (seen.empty()) seen.push_back(steadyPicture(rig));
    rig.plant(cloudOf(look));
    rig.blow(1);
    ASSERT_TRUE(
        rig.until([&] { return display->drawn().plants == 1 && display->drawn().drawn > 0; }));
    seen.push_back(steadyPicture(rig));
  }
  const double leaves = difference(seen[0], seen[1]), puffs = difference(seen[0], seen[2]);
  const double change = difference(seen[1], seen[2]);
  std::cout << "mean change by leaves " << leaves << ", by puffs " << puffs << ", between them "
            << change << " of 255\n";
  EXPECT_GT(puffs, 1.0);
  EXPECT_GT(change, 1.0);
}

// S3-01, S3-30: the leaves of each plant appear in front of a sky, on grass.
TEST_F(CanopyDisplayTest, DrawsLeavesOnGrassUnderASky) {
  rig.frames(5);
  const ImageStatistics seen = rig.imageStatistics();
  EXPECT_GT(seen.green, 0.2);
  EXPECT_GT(seen.blue, 0.05);
  EXPECT_EQ(display->drawn().drawn, display->drawn().leaves);
  EXPECT_EQ(display->drawn().leaves, 2u * 600 + 2u * 40 * 6);
}

// Plants below trees of another display are darker, and as before without them.
TEST_F(CanopyDisplayTest, PlantsAreInTheShadeOfTrees) {
  rig.lookAt(0.8f, 0.6, 4.0);
  display->subProp("Ground")->setValue(false);
  rig.blow(1);
  rig.frames(5);
  const std::vector<std::uint8_t> sunny = steadyPicture(rig);
  {
    const view::SharedLight light(rig.manager().getSceneManager(), "map", lightBelowARoof());
    ASSERT_TRUE(rig.until([&] { return difference(sunny, rig.picture()) > 1.0; }));
    EXPECT_LT(brightnessOfPlants(steadyPicture(rig)), 0.8 * brightnessOfPlants(sunny));
  }
  EXPECT_TRUE(rig.until([&] { return difference(sunny, rig.picture()) < 0.1; }))
      << difference(sunny, rig.picture());
  display->subProp("Ground")->setValue(true);
}

// S3-27: leaves move only with received states.
TEST_F(CanopyDisplayTest, MovesWithTheStateAlone) {
  rig.frames(5);
  const std::vector<std::uint8_t> before = rig.picture();
  rig.frames(10);
  EXPECT_EQ(rig.picture(), before);
  rig.blow(60);
  EXPECT_TRUE(rig.until([&] { return difference(before, rig.picture()) > 0.3; }));
}

// Leaves and stems lean with what bodies have pushed, and stand again.
TEST_F(CanopyDisplayTest, BendsWhatBodiesPush) {
  canopy::Layout bare = CanopyRig::shrubs(4);
  bare.kinds[0].leaves = bare.kinds[1].leaves = 1;
  bare.kinds[0].stems = bare.kinds[1].stems = 40;
  bare.kinds[0].stem_radius = 0.03;
  for (const canopy::Layout& layout : {CanopyRig::shrubs(4), bare}) {
    rig.plant(layout);
    rig.blow(1);
    ASSERT_TRUE(rig.until([&] { return display->drawn().leaves == layout.leafCount(); }));
    rig.frames(10);
    const std::vector<std::uint8_t> upright = rig.picture();
    rig.pushApart();
    EXPECT_TRUE(rig.until([&] { return difference(upright, rig.picture()) > 1.0; }));
    rig.publish(rig.message());
    EXPECT_TRUE(rig.until([&] { return rig.picture() == upright; }));
  }
}

TEST_F(CanopyDisplayTest, WhatIsCutOffLiesOnTheGroundUntilAReset) {
  rig.blow(1);
  const std::vector<std::uint8_t> whole = steadyPicture(rig);
  rig.cut({0, 1}, 0.4);
  EXPECT_TRUE(rig.until([&] { return difference(whole, rig.picture()) > 0.5; }));
  // Each leaf stands or lies.
  EXPECT_EQ(display->drawn().leaves, 2u * (600 + 40 * 6));
  rig.reset();
  EXPECT_TRUE(rig.until([&] { return difference(whole, rig.picture()) < 0.1; }))
      << difference(whole, rig.picture());
}

// The ground must be as one that is painted after the cut, and after the reset.
TEST_F(CanopyDisplayTest, WhatIsCutOffGivesNoShadow) {
  rig.lookAt(0.8f, 0.9, 6.0);
  rig.blow(1);
  const auto expectGroundOfThePlants = [&](const char* when) {
    rig.frames(5);
    const std::vector<std::uint8_t> repainted = rig.picture();
    display->subProp("Ground")->setValue(false);
    rig.frames(2);
    display->subProp("Ground")->setValue(true);
    rig.frames(5);
    EXPECT_LT(difference(repainted, rig.picture()), 1e-3) << when;
  };
  const std::vector<std::uint8_t> whole = steadyPicture(rig);
  rig.cut({0, 1, 2, 3}, 0.05);
  ASSERT_TRUE(rig.until([&] { return difference(whole, rig.picture()) > 1.0; }));
  expectGroundOfThePlants("after the cut");
  rig.reset();
  ASSERT_TRUE(rig.until([&] { return difference(whole, rig.picture()) < 0.1; }));
  expectGroundOfThePlants("after the reset");
}

// S3-W2: leaves on trees of the forest, in layers where no plant stands, move with their wood at
// the time of rviz, whatever the state of the canopy is.
TEST_F(CanopyDisplayTest, CrownsGoWithTheirForest) {
  canopy::Layout crowns = CanopyRig::shrubs(0);
  crowns.crowns.resize(1);
  crowns.crowns[0].trees = 4;
  rig.plant(crowns);
  forest::Layout trees = forest::gridLayout(2, 2.0);
  for (forest::TreeSeed& tree : trees.trees) tree.scale = 0.3;
  rig.publishForest(trees);
  rig.blow(2);
  rig.lookAt(1.5f, 0.25, 8.0);
  ASSERT_TRUE(rig.until([&] {
    const view::CanopyReport drawn = display->drawn();
    return drawn.crowns == 4 && drawn.drawn > 0 && drawn.layers == 3;
  }));
  EXPECT_EQ(display->drawn().plants, 0u);
  EXPECT_EQ(display->drawn().leaves, 4u * 600);
  rig.frames(5);
  const std::vector<std::uint8_t> before = rig.picture();
  rig.frames(10);
  EXPECT_EQ(rig.picture(), before);
  EXPECT_TRUE(rig.until([&] {
    rig.setTime(rig.now() + 0.02);
    return difference(before, rig.picture()) > 0.3;
  }));
}

// The names of the forest's topics are checked before there are crowns.
TEST_F(CanopyDisplayTest, InvalidForestTopicsAreReported) {
  canopy::Layout crowns = CanopyRig::shrubs(0);
  crowns.crowns.resize(1);
  crowns.crowns[0].trees = 4;
  for (const char* name : {"Forest Layout Topic", "Forest State Topic", "Wind Topic"}) {
    rviz::Property& topic = *display->subProp(name);
    const QVariant good = topic.getValue();
    topic.setValue("no name!");
    rig.plant(crowns);
    rig.frames(5);
    EXPECT_NE(statusOf(*display, "Topics"), "") << name;
    topic.setValue(good);
    rig.frames(5);
    EXPECT_EQ(statusOf(*display, "Topics"), "") << name;
  }
}

// Far away fewer leaves represent all, and the plants keep their size in the image.
TEST_F(CanopyDisplayTest, FarLeavesAreFewer) {
  rig.lookAt(0.8f, 0.25, 60.0);
  EXPECT_TRUE(rig.until([&] {
    return display->drawn().drawn > 0 && 3 * display->drawn().drawn < display->drawn().leaves;
  })) << display->drawn().drawn;
}

TEST_F(CanopyDisplayTest, KeepsToTheLeaves) {
  display->subProp("Leaves")->setValue(300);
  EXPECT_TRUE(rig.until([&] {
    return display->drawn().drawn > 0 && display->drawn().drawn <= 304;
  })) << display->drawn().drawn;
}

// N7: frames that take longer than wanted have fewer leaves, whatever takes the time. Their number
// follows although neither leaves nor viewer move.
TEST_F(CanopyDisplayTest, DrawsFewerLeavesWhileFramesTakeTooLong) {
  setTolerance(0.0);
  display->subProp("Tolerance")->setValue(0.1);  // every leaf
  const std::size_t all = display->drawn().leaves;
  const auto leaves = [&] { return display->drawn().drawn; };
  ASSERT_TRUE(rig.until([&] { return leaves() == all; })) << leaves() << " of " << all;
  display->subProp("Frame Time")->setValue(1.0);  // less than any frame takes
  EXPECT_TRUE(rig.until([&] { return leaves() < all / 3; })) << leaves() << " of " << all;
  EXPECT_GT(leaves(), 0u);
  display->subProp("Frame Time")->setValue(0.0);
  EXPECT_TRUE(rig.until([&] { return leaves() == all; })) << leaves() << " of " << all;
}

TEST_F(CanopyDisplayTest, RejectsInvalidMessagesAndKeepsItsState) {
  CanopyLayout layout = toMsg(CanopyRig::shrubs(2));
  layout.header.frame_id = "map";
  layout.plants[0].position.x = std::numeric_limits<double>::quiet_NaN();
  rig.publish(layout);
  CanopyState state = rig.message();
  state.layout_hash ^= 1;
  rig.publish(state);
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*display, "Layout").rfind("Rejected", 0) == 0 &&
           statusOf(*display, "State").find("layout_hash") != std::string::npos;
  })) << statusOf(*display, "Layout")
      << "; " << statusOf(*display, "State");
  state = rig.message();
  state.front_share = std::numeric_limits<double>::quiet_NaN();
  rig.publish(state);
  EXPECT_TRUE(rig.until([&] {
    return statusOf(*display, "State").find("front_share") != std::string::npos;
  })) << statusOf(*display, "State");
  EXPECT_EQ(display->drawn().plants, 4u);
}

TEST_F(CanopyDisplayTest, SurvivesTimeGoingBack) {
  rig.blow(10);
  ASSERT_TRUE(rig.until([&] { return statusOf(*display, "State") == "In step"; }));
  rig.setTime(rig.now() - 50.0);
  EXPECT_TRUE(rig.until([&] { return statusOf(*display, "State") != "In step"; }));
  rig.plant(2);
  rig.blow(2);
  EXPECT_TRUE(rig.until([&] { return display->drawn().plants == 2; }));
}

TEST_F(CanopyDisplayTest, ReportsMissingStates) {
  ASSERT_TRUE(rig.until([&] { return display->drawn().drawn > 0; }));
  expectSilenceIsReported(rig, *display, [&] { rig.blow(1); });
}

TEST_F(CanopyDisplayTest, FollowsANodeThatDiesAndReturns) {
  expectReloadsAreFollowed(
      rig,
      [&](int scene) {
        rig.startNode();
        rig.plant(scene == 0 ? 4 : 2);
        for (int i = 0; i < 100; ++i) rig.publish(rig.message());
      },
      [&](int scene) {
        return display->drawn().plants == (scene == 0 ? 4u : 2u) && display->drawn().drawn > 0;
      });
}

// N7
TEST_F(CanopyDisplayTest, ShowsTheGovernorsChoice) {
  expectAllocationIsReported(rig, *display, "canopy_animator", "Cost [points]", "Budget [points]",
                             "points");
}

TEST_F(CanopyDisplayTest, EveryPropertyCanBeChanged) {
  expectEveryPropertyCanBeChanged(rig, *display);
  EXPECT_TRUE(rig.until([&] { return display->drawn().drawn == display->drawn().leaves; }));
}

TEST_F(CanopyDisplayTest, SettingsSurviveSaveAndLoad) {
  expectSettingsSurvive(rig, *display, [&] { return rig.addDisplay(); });
}

TEST_F(CanopyDisplayTest, LeavesNothingBehind) {
  rig.remove(display);
  display = nullptr;
  expectNothingLeftBehind(
      rig, [&] { return rig.addDisplay(); },
      [&](rviz::Display& another) {
        return static_cast<CanopyDisplay&>(another).drawn().drawn > 0;
      });
}

TEST_F(CanopyDisplayTest, StandsInAnyFixedFrame) {
  expectStandsInAnyFixedFrame(rig, *display);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "canopy_display_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
