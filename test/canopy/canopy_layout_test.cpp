// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/canopy_layout.h"

#include <gtest/gtest.h>

#include <map>

#include "canopy/canopy_layout_reader.h"
#include "core/config/scenario.h"
#include "core/error_text.h"
#include "package_folder.h"
#include "scenes/canopy/canopy_scene.h"

namespace vegetation_sim::canopy {
namespace {

const std::string FOLDER = PACKAGE_FOLDER "/config/scenarios";

Layout read(const std::string& text) {
  Scenario scenario = Scenario::parse(text, "scene.yaml");
  const terrain::HeightMap flat;
  Layout out = readLayout(scenario.section("canopy"), FOLDER, flat, 9, scenario.faults());
  scenario.finish();
  return out;
}

TEST(Layout, IsReadWithItsGroupsKindsPlantsAndBeds) {
  const Layout layout = read(
      "canopy:\n"
      "  plane: {camera: [0, -6, 2], yaw: 1.5}\n"
      "  fluid: {scheme: fast, cells: 128}\n"
      "  oscillator: {frequency: 0.3}\n"
      "  rate: 60\n"
      "  kinds: [{name: kelp, shape: kelp, leaves: 40, pieces: 5}]\n"
      "  plants: [{kind: kelp, position: [1, 2, 0], scale: 1.5}]\n"
      "  beds: [{kind: kelp, corner: [0, 0, 0], width: 4, depth: 3, count: 7}]\n");
  EXPECT_EQ(layout.motion.fluid.scheme, Scheme::FAST);
  EXPECT_EQ(layout.motion.rate, 60);
  ASSERT_EQ(layout.plants.size(), 8U);
  EXPECT_EQ(layout.leafCount(), 8U * 200U);
  for (std::size_t i = 1; i < 8; ++i) {
    EXPECT_LE(layout.plants[i].position.x(), 4.0);
    EXPECT_NE(layout.plants[i].seed, layout.plants[i - 1].seed);
  }
}

// S3-14: `tiling: blend` of a scenario takes the middle of the plane for its edges.
TEST(Layout, BlendsTheSeamsOfItsPlaneIfAsked) {
  const auto motionAt = [](const std::string& tiling, double across) {
    Canopy canopy(read("canopy:\n  plane: {tiling: " + tiling +
                       "}\n  fluid: {cells: 32}\n"
                       "  kinds: [{name: shrub}]\n  plants: [{kind: shrub}]\n"));
    canopy.setWind(breezeFrom(Vec3(0.0, 0.5, 0.0)));
    run(canopy, 0, 90);
    const Plane plane(canopy.layout().motion.plane);
    const Vec3 at = plane.centre + across * plane.width * plane.axes.right;
    return canopy.foliage().motion(at, at);
  };
  const Vec3 edge = motionAt("blend", -0.5), middle = motionAt("periodic", 0.0);
  EXPECT_GT(length(middle), 1e-3);
  EXPECT_NEAR(length(Vec3(edge - middle)), 0.0, 1e-9 * length(middle));
  EXPECT_GT(length(Vec3(edge - motionAt("periodic", -0.5))), 0.01 * length(middle));
}

TEST(Layout, PlantsRowsOnTheTerrain) {
  Scenario scenario = Scenario::parse(
      "canopy: {kinds: [{name: maize, shape: stalk, stage: 0.5}], rows: [{kind: maize, rows: 2,"
      " plants: 3, spacing: slope, plant_spacing: 0.17, origin: [0, 0, 0.2]}]}",
      "scene.yaml");
  terrain::HeightMapLaw law;
  law.resolution = 10.0;
  law.height_max = 4.0;
  const terrain::HeightMap slope(law, {2, 2, 1, {0, 1, 0, 1}});
  const Layout layout = readLayout(scenario.section("canopy"), FOLDER, slope, 9, scenario.faults());
  scenario.finish();
  ASSERT_EQ(layout.plants.size(), 6U);
  for (const Plant& plant : layout.plants)
    EXPECT_NEAR(plant.position.z(), 0.2 + 0.4 * plant.position.x(), 1e-12);
  EXPECT_NEAR(length(Vec3(layout.plants[1].position - layout.plants[0].position)), 0.17, 1e-9);
  EXPECT_NEAR(layout.kinds[0].height, (0.05 + 0.95 * 0.5) * PlantKind().height, 1e-12);
}

TEST(Layout, IsRejectedWithAllItsFaults) {
  const std::string text = errorOf([] {
    read(
        "canopy:\n"
        "  fluid: {cells: 48, scheme: quick}\n"
        "  oscillator: {frequency: -1}\n"
        "  warp: {rigidity: 11, lamda: [1, 1, 1]}\n"
        "  kinds: [{name: shrub, leaves: -4}]\n"
        "  plants: [{kind: tree}]\n"
        "  rows: [{kind: bush, rows: 0, gap: 1}]\n");
  });
  for (const char* part :
       {"scheme = 'quick' is none of reflection, fast, paper", "frequency = -1 Hz is outside",
        "rigidity = 11 is outside 0 to 10", "lamda", "leaves = -4",
        "kind = 'tree' is none of shrub", "rows[0]: kind = 'bush' is none of shrub",
        "rows = 0 is outside 1", "gap is not a known key"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

// S3-28: plants of a mesh share its faces, so that 50 million can be shown.
TEST(Layout, CountsTheFacesOfAMeshOnce) {
  Layout layout;
  layout.kinds.resize(2);
  layout.kinds[0].leaves = 1000;
  layout.kinds[1].shape = PlantShape::MESH;
  layout.kinds[1].file = "bush.obj";
  auto form = std::make_shared<Form>();
  form->leaves.resize(80000);
  layout.kinds[1].form = form;
  layout.plants.resize(3);
  for (int i = 0; i < 625; ++i) {
    layout.plants.emplace_back();
    layout.plants.back().kind = 1;
  }
  EXPECT_EQ(layout.leafCount(), 3u * 1000 + 625u * 80000);
  EXPECT_EQ(layout.ownLeafCount(), 3u * 1000 + 80000);
  const auto faultsOf = [&] {
    Faults faults;
    check(layout, faults);
    return faults.text();
  };
  EXPECT_EQ(faultsOf(), "");
  layout.plants.insert(layout.plants.end(), 700, layout.plants.back());
  EXPECT_NE(faultsOf().find("106003000 leaves of all plants, more than the 100000000 allowed"),
            std::string::npos)
      << faultsOf();
}

TEST(Layout, IsRejectedAsAWhole) {
  EXPECT_NE(errorOf([] { read("canopy: {fluid: {cells: 48}}"); }).find("no power of two"),
            std::string::npos);
  EXPECT_NE(errorOf([] {
              read(
                  "canopy: {kinds: [{name: a, leaves: 1000000}], "
                  "beds: [{kind: a, count: 4}]}");
            }).find("4000000 leaves, more than"),
            std::string::npos);
  const std::string pushed = errorOf([] {
    read(
        "canopy: {kinds: [{name: a, push_stiffness: -1, push_frequency: 0, push_damping: 51, "
        "push_set: 1.1, push_recovery: 0, push_pressure: 2e7, push_drag: .nan, push_cell: 0.01}]}");
  });
  for (const char* fault :
       {"push_stiffness = -1 N/m^3 is outside 0 to 1e+06", "push_frequency = 0 Hz is outside 0.05",
        "push_damping = 51 is outside 0 to 50", "push_set = 1.1 is outside 0 to 1",
        "push_recovery = 0 s is outside 0.01", "push_pressure = 2e+07 N/m^3 is outside 0 to 1e+07",
        "push_drag = nan N s/m^4 is not finite", "push_cell = 0.01 m is outside 0.02 to 100"})
    EXPECT_NE(pushed.find(fault), std::string::npos) << fault << "\n" << pushed;
  EXPECT_NE(
      errorOf([] {
        read("canopy: {kinds: [{name: a, push_stiffness: 0}, {name: b, push_stiffness: 1e-12}]}");
      }).find("kinds[1]: push_stiffness above 0 = 1e-12 N/m^3 is outside 0.001 to 1e+06"),
      std::string::npos);
  EXPECT_NE(errorOf([] {
              read("canopy: {fluid: {cells: 256}, layers: {memory: 10}, rate: 240}");
            }).find("bytes of history"),
            std::string::npos);
}

// S3-30, N11: shrubs and crowns in the wind, water plants in a current.
TEST(Layout, OfEachScenarioIsAcceptedAndMoves) {
  for (const char* name : {"grove", "reef"}) {
    Scenario scenario =
        Scenario::load(PACKAGE_FOLDER "/config/scenarios/" + std::string(name) + ".yaml");
    const terrain::HeightMap flat;
    const Layout layout =
        readLayout(scenario.section("canopy"), FOLDER, flat, 1, scenario.faults());
    scenario.finish();
    EXPECT_GT(layout.leafCount(), 10000U) << name;
    EXPECT_LT(6 * layout.leafCount(), 300000U) << name;
    Canopy canopy(layout);
    canopy.setWind(breezeFrom(Vec3(0.3, 1.0, 0.0)));
    run(canopy, 0, 90);
    const Plant& plant = layout.plants[0];
    const Vec3 top = plant.position + Vec3(0.0, 0.0, 1.0);
    EXPECT_GT(length(canopy.foliage().displacement(top, top, 0)), 0.005) << name;
  }
}

// S3-05, S3-30: the last scene of figure 1 of paper 3 has grass, shrubs, crowns and a tree in five
// layers, "3-1-1", each of which is dense.
TEST(Layout, OfTheGroveFillsTheFiveLayersOfThePaper) {
  Scenario scenario = Scenario::load(PACKAGE_FOLDER "/config/scenarios/grove.yaml");
  const terrain::HeightMap flat;
  const Layout layout = readLayout(scenario.section("canopy"), FOLDER, flat, 1, scenario.faults());
  scenario.finish();
  EXPECT_EQ(layout.motion.cuts.near_layers, 3);
  EXPECT_EQ(layout.motion.cuts.mid_layers, 1);
  EXPECT_EQ(layout.motion.cuts.far_layers, 1);
  EXPECT_EQ(layout.crowns.size(), 1U);
  Canopy canopy(layout);
  run(canopy, 0, 2);
  ASSERT_EQ(canopy.foliage().layers(), 5);
  std::vector<int> leaves(5);
  std::map<std::string, int> plants;
  for (const Plant& plant : layout.plants) {
    const PlantKind& kind = layout.kinds[plant.kind];
    ++plants[kind.name];
    for (const Leaf& leaf : grow(kind, plant).leaves)
      ++leaves[static_cast<std::size_t>(canopy.foliage().layerAt(leaf.anchor))];
  }
  for (std::size_t layer = 0; layer < leaves.size(); ++layer)
    EXPECT_GT(leaves[layer], 1000) << layer;
  for (const char* kind : {"grass", "shrub", "crown", "fern"}) EXPECT_GT(plants[kind], 1) << kind;
}

// N11: crops are described once, in config/plants.
TEST(Layout, KindsTakeTheValuesOfTheirBase) {
  const Layout layout =
      read("canopy: {kinds: [{base: maize}, {base: maize, name: tall, height: 3}]}");
  ASSERT_EQ(layout.kinds.size(), 2u);
  EXPECT_EQ(layout.kinds[0].name, "maize");
  EXPECT_EQ(layout.kinds[0].shape, PlantShape::STALK);
  EXPECT_EQ(layout.kinds[0].height, 2.4);
  EXPECT_EQ(layout.kinds[0].push.stiffness, 6.0);
  EXPECT_EQ(layout.kinds[1].name, "tall");
  EXPECT_EQ(layout.kinds[1].height, 3.0);
  EXPECT_EQ(layout.kinds[1].leaves, layout.kinds[0].leaves);
  const auto fault = [](const std::string& base) {
    return errorOf([&] { read("canopy: {kinds: [{base: " + base + "}]}"); });
  };
  EXPECT_NE(fault("banana").find("kinds[0]: base = 'banana': "), std::string::npos);
  EXPECT_NE(fault("../species/oak").find("has other letters than a to z"), std::string::npos);
  // A message reads no file.
  EXPECT_NE(errorOf([] { parseLaw("kinds: [{base: maize}]", "law"); }).find("base is not a known"),
            std::string::npos);
}

TEST(Layout, SurvivesTheTextOfItsLaw) {
  Layout layout = shrubScene();
  layout.motion.warp.rigidity = 1.0 / 3.0;
  layout.motion.sources.sides[2] = {1.5, 0.25};
  layout.motion.rate = 20;
  layout.kinds[0].name = "a \"b\": c";
  const std::uint64_t without = layout.hash();
  layout.kinds[0].push.set = 1.0 / 3.0;
  EXPECT_NE(layout.hash(), without);
  Layout back = parseLaw(writeLaw(layout), "law");
  back.plants = layout.plants;
  back.seed = layout.seed;
  EXPECT_EQ(back.hash(), layout.hash());
  back.motion.warp.rigidity += 1e-15;
  EXPECT_NE(back.hash(), layout.hash());
  EXPECT_THROW(parseLaw("plane: {yaw: north}", "law"), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim::canopy
