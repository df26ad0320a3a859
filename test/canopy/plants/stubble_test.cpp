// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/plants/stubble.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error_text.h"

namespace vegetation_sim::canopy {
namespace {

constexpr double GROUND = 0.5, CUT = 0.3;  // [m]

PlantKind kindToCut(PlantShape shape) {
  PlantKind out;
  out.shape = shape;
  out.height = 2.4;
  out.radius = 0.6;
  out.leaves = shape == PlantShape::SHRUB || shape == PlantShape::CROWN ? 300 : 14;
  out.leaf_length = shape == PlantShape::STALK ? 0.9 : 0.12;
  return out;
}

Plant plantOn(double foot) {
  Plant out;
  out.seed = 7;
  out.position = Vec3(3.0, -2.0, foot);
  out.scale = 1.1;
  return out;
}

// Returns the plant without what lies on the ground.
GrownPlant standing(GrownPlant grown) {
  grown.leaves.erase(std::remove_if(grown.leaves.begin(), grown.leaves.end(),
                                    [](const Leaf& leaf) { return leaf.lies; }),
                     grown.leaves.end());
  return grown;
}

double highestOf(const GrownPlant& grown) {
  double out = -1e9;
  for (const Leaf& leaf : grown.leaves) out = std::max({out, leaf.root.z(), leaf.tip.z()});
  for (const Leaf& face : grown.rigid) out = std::max({out, face.root.z(), face.tip.z()});
  for (const Stem& stem : grown.stems) out = std::max({out, stem.from.z(), stem.to.z()});
  return out;
}

TEST(Stubble, NothingIsAboveTheCutAndStemsEndThere) {
  for (const PlantShape shape : {PlantShape::SHRUB, PlantShape::CROWN, PlantShape::REED,
                                 PlantShape::KELP, PlantShape::STALK}) {
    const PlantKind kind = kindToCut(shape);
    const Plant plant = plantOn(GROUND);
    const GrownPlant whole = grow(kind, plant), cut = standing(grow(kind, plant, CUT));
    EXPECT_GT(highestOf(whole), GROUND + 1.5);
    EXPECT_NEAR(highestOf(cut), GROUND + CUT, 1e-9);
    EXPECT_LT(cut.leaves.size(), whole.leaves.size());
    ASSERT_LE(cut.stems.size(), whole.stems.size());
    // The stems that are left begin in the same places and are as thick.
    for (std::size_t i = 0; i < cut.stems.size(); ++i) {
      EXPECT_EQ(cut.stems[i].from, whole.stems[i].from);
      EXPECT_EQ(cut.stems[i].radius, whole.stems[i].radius);
      EXPECT_NEAR(cut.stems[i].to.z(), GROUND + CUT, 1e-9);
    }
    EXPECT_EQ(grow(kind, plant, 5.0).leaves.size(), whole.leaves.size());
    const GrownPlant gone = standing(grow(kind, plant, 0.0));
    EXPECT_EQ(gone.leaves.size() + gone.stems.size() + gone.rigid.size(), 0U);
  }
}

// A ribbon is an arch: what comes after its cut has come off, even where it hangs below the height.
TEST(Stubble, OfARibbonThePiecesUpToTheCutAreLeft) {
  PlantKind kind = kindToCut(PlantShape::STALK);
  kind.leaf_length = 1.5;
  const Plant plant = plantOn(0.0);
  const GrownPlant whole = grow(kind, plant);
  std::size_t hanging = 0;
  for (const double height : {0.5, 0.7, 0.9, 1.1, 1.3}) {
    const GrownPlant cut = standing(grow(kind, plant, height));
    std::size_t expected = 0;
    bool is_cut = false;
    for (std::size_t i = 0; i < whole.leaves.size(); ++i) {
      const Leaf& leaf = whole.leaves[i];
      if (i == 0 || leaf.root != whole.leaves[i - 1].tip) is_cut = false;
      hanging += is_cut && leaf.root.z() < height;
      if (!is_cut && leaf.root.z() < height) {
        ASSERT_LT(expected, cut.leaves.size());
        const Leaf& left = cut.leaves[expected++];
        EXPECT_EQ(left.root, leaf.root);
        EXPECT_NEAR(left.tip.z(), std::min(leaf.tip.z(), height), 1e-12);
        EXPECT_GE(left.tip_width, std::min(leaf.root_width, leaf.tip_width));
      }
      is_cut = is_cut || leaf.tip.z() > height || leaf.root.z() >= height;
    }
    EXPECT_EQ(expected, cut.leaves.size());
  }
  EXPECT_GE(hanging, 3U);
}

TEST(Stubble, AFaceOfAMeshIsKeptWholeUnlessItHangsAbove) {
  Leaf face;
  face.joined = true;
  face.root = Vec3(0.0, 0.0, 0.2);
  face.tip = Vec3(0.0, 0.0, 0.6);
  Leaf above = face, hanging = face;
  above.root.z() = 0.5;
  hanging.anchor.z() = 0.9;
  GrownPlant plant;
  plant.leaves = {face, above, hanging};
  plant.rigid = {above, face};
  EXPECT_TRUE(cutOff(0.4, plant).empty());  // faces vanish
  ASSERT_EQ(plant.leaves.size(), 1U);
  EXPECT_EQ(plant.leaves[0].tip.z(), 0.6);
  EXPECT_EQ(plant.rigid.size(), 1U);
}

TEST(Stubble, FaultsNameThePlantAndTheHeight) {
  EXPECT_EQ(errorOf([] { checkStubble({{2, 0.0}, {1, 5.0}}, 3, "state: "); }), "");
  const std::string text = errorOf([] { checkStubble({{3, 0.1}, {1, -0.5}}, 3, "state: "); });
  EXPECT_NE(text.find("state: cut of plant 3: there are 3 plants"), std::string::npos) << text;
  EXPECT_NE(text.find("state: cut of plant 1: height = -0.5 m is outside 0 to 5 m"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace vegetation_sim::canopy
