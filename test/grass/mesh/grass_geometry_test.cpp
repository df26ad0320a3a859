// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/mesh/grass_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "reference/grass/blade_plain.h"
#include "reference/grass/ribbons_plain.h"
#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::grass {
namespace {

Vec3 vertex(const GrassMesh& mesh, std::size_t i) {
  return {mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]};
}

void expectSound(const GrassMesh& mesh) {
  EXPECT_EQ(mesh.texture.size(), 2 * mesh.vertexCount());
  EXPECT_EQ(mesh.colours.size(), 4 * mesh.vertexCount());
  for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertexCount());
  for (const float p : mesh.positions) ASSERT_TRUE(std::isfinite(p));
}

// S2-07, S2-08: n segments make 2 n + 1 vertices and 2 n - 1 triangles from root to tip.
TEST(Ribbons, HaveTheSegmentsAsked) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 0, 0);
  const auto blocks = posed(tile, TileMotion(), 100);
  for (const int segments : {1, 2, 3, 5}) {
    GrassMesh mesh;
    RibbonStyle style;
    style.segments = segments;
    appendRibbons(map, tile, blocks.data(), 100, style, mesh);
    expectSound(mesh);
    const auto n = static_cast<std::size_t>(segments);
    EXPECT_EQ(mesh.vertexCount(), 100 * (2 * n + 1));
    EXPECT_EQ(mesh.indices.size(), 3 * 100 * (2 * n - 1));
    for (std::size_t blade = 0; blade < 100; ++blade) {
      const Vec3 root =
          0.5 * (vertex(mesh, blade * (2 * n + 1)) + vertex(mesh, blade * (2 * n + 1) + 1));
      const Vec3 tip = vertex(mesh, blade * (2 * n + 1) + 2 * n);
      EXPECT_LT((root - pointOf(blocks, static_cast<int>(blade), 0)).norm(), 1e-6);
      EXPECT_LT((tip - pointOf(blocks, static_cast<int>(blade), LINKS)).norm(), 1e-6);
    }
  }
}

TEST(Ribbons, FaceTheEye) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 0, 0);
  const auto blocks = posed(tile, TileMotion(), 50);
  GrassMesh mesh;
  RibbonStyle style;
  style.eye = Vec3(-5, 3, 1.6);
  appendRibbons(map, tile, blocks.data(), 50, style, mesh);
  for (std::size_t blade = 0; blade < 50; ++blade) {
    const Vec3 side = vertex(mesh, 11 * blade + 1) - vertex(mesh, 11 * blade);
    EXPECT_NEAR(side.norm(), map.species()[0].species.width, 1e-5);
    EXPECT_NEAR(side.dot(style.eye - vertex(mesh, 11 * blade)) / side.norm(), 0.0, 5e-3);
  }
}

// S2-15: blades that are the next to go narrow to nothing, one after the other; the others do not.
TEST(Ribbons, TheLastOnesNarrowBeforeTheyGo) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 3, 4);
  const auto blocks = posed(tile, TileMotion(), 100);
  GrassMesh mesh;
  RibbonStyle style;
  style.leaving = 0.4;
  appendRibbons(map, tile, blocks.data(), 100, style, mesh);
  for (std::size_t blade = 0; blade < 100; ++blade) {
    const Vec3 side = vertex(mesh, 11 * blade + 1) - vertex(mesh, 11 * blade);
    const double part = std::min(1.0, (100.0 - static_cast<double>(blade)) / 40.0);
    EXPECT_NEAR(side.norm(), part * map.species()[0].species.width, 1e-5) << blade;
  }
}

// S2-12: fully slid, every blade stands on an edge of its tile; half way, half way there.
TEST(Ribbons, SlideToTheNearestEdge) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 3, 4);
  const auto blocks = posed(tile, TileMotion(), 200);
  const auto rootsAt = [&](double slide) {
    GrassMesh mesh;
    RibbonStyle style;
    style.slide = slide;
    appendRibbons(map, tile, blocks.data(), 200, style, mesh);
    std::vector<Vec3> roots;
    for (std::size_t blade = 0; blade < 200; ++blade)
      roots.push_back(0.5 * (vertex(mesh, 11 * blade) + vertex(mesh, 11 * blade + 1)));
    return roots;
  };
  const auto none = rootsAt(0.0), half = rootsAt(0.5), all = rootsAt(1.0);
  for (std::size_t i = 0; i < none.size(); ++i) {
    const double u = all[i].x() - tile.x, v = all[i].y() - tile.y;
    const double off =
        std::min({std::fabs(u), std::fabs(2.0 - u), std::fabs(v), std::fabs(2.0 - v)});
    EXPECT_LT(off, 1e-5);
    EXPECT_LE((all[i] - none[i]).norm(), 1.0);
    EXPECT_LT((half[i] - 0.5 * (none[i] + all[i])).norm(), 1e-5);
  }
}

// S2-W2: flowers stand at the tips of their species only.
TEST(Ribbons, FlowersStandAtTheTips) {
  MapInput input;
  input.species.resize(2);
  input.species[1].species.name = "daisy";
  input.species[1].species.flower_radius = 0.02;
  const FeatureMap map(input);
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 0, 0);
  const auto blocks = posed(tile, TileMotion(), 500);
  GrassMesh mesh;
  appendRibbons(map, tile, blocks.data(), 500, RibbonStyle(), mesh);
  std::size_t flowers = 0;
  for (int blade = 0; blade < 500; ++blade) flowers += traitsOf(tile, blade).species == 1;
  EXPECT_GT(flowers, 150u);
  EXPECT_EQ(mesh.indices.size(), 3 * (500 * 9 + 6 * flowers));
  CrushPatch patch = rampPatch(0.f, 0.f, 0.f);
  patch.cut.assign(patch.tilt.size(), 0.05f);  // the mower takes the flowers
  patch.swath.assign(patch.tilt.size(), 0.f);
  RibbonStyle mown;
  mown.crush = &patch;
  mesh.clear();
  appendRibbons(map, tile, blocks.data(), 500, mown, mesh);
  EXPECT_EQ(mesh.indices.size(), 3u * 500u * 9u);
}

// Varied blades differ in length, some have a seed head of 7 vertices, and their siblings stand
// within `spread` of them without one.
TEST(Ribbons, VariedOnesDifferInLengthAndHaveSeedHeads) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 0, 0);
  const auto blocks = posed(tile, TileMotion(), 500);
  GrassMesh mesh;
  RibbonStyle style;
  style.variety = 1.f;
  style.spread = 0.04;
  appendRibbons(map, tile, blocks.data(), 500, style, mesh);
  expectSound(mesh);
  EXPECT_GT(mesh.vertexCount(), 500u * 11u + 8u * 7u);
  EXPECT_LT(mesh.vertexCount(), 500u * 11u + 80u * 7u);
  mesh.clear();
  style.sibling = 1;
  appendRibbons(map, tile, blocks.data(), 500, style, mesh);
  ASSERT_EQ(mesh.vertexCount(), 500u * 11u);
  double shortest = 10.0, longest = 0.0;
  for (int blade = 0; blade < 500; ++blade) {
    const std::size_t first = 11 * static_cast<std::size_t>(blade);
    const Vec3 root = 0.5 * (vertex(mesh, first) + vertex(mesh, first + 1));
    const Vec3 own = pointOf(blocks, blade, 0), way = root - own;
    EXPECT_LE(std::max(std::fabs(way.x()), std::fabs(way.y())), style.spread + 1e-5);
    const double part =
        (vertex(mesh, first + 10) - root).norm() / (pointOf(blocks, blade, LINKS) - own).norm();
    shortest = std::min(shortest, part);
    longest = std::max(longest, part);
  }
  EXPECT_LT(shortest, 0.8);
  EXPECT_GT(longest, 1.0);
}

// In drifts stand only some of the flowers of varied blades.
TEST(Ribbons, VariedOnesHaveFewerFlowers) {
  MapInput input;
  input.species.resize(1);
  input.species.front().species.flower_radius = 0.02;
  const FeatureMap map(input);
  std::size_t flowers = 0, blades = 0;
  for (int column = 0; column < 8; ++column) {
    const Tile tile = makeTile(map, terrain::HeightMap(), 1, column, 0);
    const auto blocks = posed(tile, TileMotion(), 200);
    GrassMesh mesh;
    RibbonStyle style;
    style.variety = 1.f;
    appendRibbons(map, tile, blocks.data(), 200, style, mesh);
    flowers += (mesh.vertexCount() - 200u * 11u) / 7u;
    blades += 200;
  }
  EXPECT_GT(flowers, blades / 10);
  EXPECT_LT(flowers, blades * 3 / 4);
}

// A meadow with and without flowers, sloped, trodden and mown in the east.
struct RibbonScene {
  explicit RibbonScene(int species) : patch(rampPatch(1.2f, 0.8f, 0.6f)) {
    MapInput input;
    input.species.resize(static_cast<std::size_t>(species));
    for (std::size_t s = 1; s < input.species.size(); ++s) {
      input.species[s].species.name += std::to_string(s);
      input.species[s].species.flower_radius = s % 2 == 1 ? 0.01 : 0.0;
      input.species[s].species.flower_colour = Vec3(0.9, s == 1 ? 0.9 : 0.2, 0.9);
      input.species[s].species.colour = Vec3(0.2, 0.3 + 0.1 * static_cast<double>(s), 0.1);
      input.species[s].species.width *= 1.0 + static_cast<double>(s);
    }
    input.colour = {0.0, {2, 2, 1, {0, 1, 1, 0}}, 0.0, 1.0};
    map = FeatureMap(input);
    tile = makeTile(map, slopedGround(0.3, -0.1), 3, 4, 5);
    motion.wind_x = {5.f, -6.f, 4.f, 50.f};
    motion.wind_y = {0.f, 1.f, -1.f, 0.5f};
    for (std::size_t i = 0; i < patch.tilt.size(); ++i) {
      patch.cut.push_back(i % 11 < 5 ? UNCUT : 0.06f);
      patch.swath.push_back(0.01f * static_cast<float>(i % 7));
    }
  }
  FeatureMap map;
  CrushPatch patch;
  Tile tile;
  TileMotion motion;
};

std::vector<RibbonStyle> ribbonStyles(const CrushPatch& patch, const GrassLight& light) {
  std::vector<RibbonStyle> out;
  for (const int segments : {1, 2, 3, 5})
    for (const bool lit : {false, true})
      for (const bool mown : {false, true}) {
        RibbonStyle style;
        style.segments = segments;
        style.eye = Vec3(7.0, 9.0, 6.5);
        style.light = lit ? &light : nullptr;
        style.crush = mown ? &patch : nullptr;
        style.slide = mown ? 0.0 : 0.3;
        style.leaving = lit ? 0.25 : 0.0;
        style.variety = lit ? 1.f : 0.f;
        style.width = lit ? 1.7 : 1.0;
        style.sibling = lit && segments == 2 ? 1 : 0;
        style.spread = 0.05;
        out.push_back(style);
      }
  return out;
}

TEST(Ribbons, HaveTheBitsOfPlainOnesOnEveryInstructionSet) {
  const GrassLight light;
  for (const int species : {1, 4}) {
    RibbonScene scene(species);
    for (const bool mown : {false, true}) {
      scene.motion.crush = mown ? &scene.patch : nullptr;
      for (const int count : {1, 15, 16, 333}) {
        const auto blocks = posed(scene.tile, scene.motion, count);
        for (const RibbonStyle& style : ribbonStyles(scene.patch, light)) {
          GrassMesh plain;
          plain.origin = Vec3(3.0, 4.0, 0.5);
          appendRibbonsPlain(scene.map, scene.tile, blocks.data(), count, style, plain);
          appendRibbonsPlain(scene.map, scene.tile, blocks.data(), count, style, plain);
          for (const std::string& set : instructionSets()) {
            forceInstructionSet(set);
            GrassMesh mesh;
            mesh.origin = plain.origin;
            for (int i = 0; i < 2; ++i)
              appendRibbons(scene.map, scene.tile, blocks.data(), count, style, mesh);
            forceInstructionSet("");
            ASSERT_EQ(mesh.positions, plain.positions) << set << ", " << style.segments;
            ASSERT_EQ(mesh.texture, plain.texture) << set << ", " << style.segments;
            ASSERT_EQ(mesh.colours, plain.colours) << set << ", " << style.segments;
            ASSERT_EQ(mesh.indices, plain.indices) << set << ", " << style.segments;
          }
        }
      }
    }
  }
}

// S2-10: four strips stand on the four edges, as high as the grass.
TEST(Strips, StandOnTheEdgesOfTheTile) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  GrassMesh mesh;
  appendStrips(map, tile, TileMotion(), 1.0, 800.0, mesh);
  expectSound(mesh);
  EXPECT_EQ(mesh.indices.size(), 3u * 4u * STRIP_CELLS * 2u);
  std::set<int> edges;
  for (std::size_t i = 0; i < mesh.vertexCount(); i += 2) {
    const Vec3 bottom = vertex(mesh, i), top = vertex(mesh, i + 1);
    EXPECT_NEAR((top - bottom).norm(), 0.3, 1e-6);
    EXPECT_NEAR(bottom.z(), 0.0, 1e-9);
    const double u = bottom.x() - tile.x, v = bottom.y() - tile.y;
    if (v == 0.0) edges.insert(0);
    if (u == 2.0) edges.insert(1);
    if (v == 2.0) edges.insert(2);
    if (u == 0.0) edges.insert(3);
    EXPECT_TRUE(u == 0.0 || u == 2.0 || v == 0.0 || v == 2.0);
  }
  EXPECT_EQ(edges.size(), 4u);
}

// S2-10: rows stand in the tile, as high as the grass, and two tiles have other ones.
TEST(Rows, StandInTheTileAndWind) {
  const FeatureMap map;
  std::set<double> places;
  for (const int column : {2, 3}) {
    const Tile tile = makeTile(map, terrain::HeightMap(), 1, column, 2);
    GrassMesh mesh;
    appendRows(map, tile, TileMotion(), 3, 1.0, 800.0, mesh);
    expectSound(mesh);
    EXPECT_EQ(mesh.vertexCount(), 2u * 3u * 4u * 2u);
    for (std::size_t i = 0; i < mesh.vertexCount(); i += 2) {
      const Vec3 bottom = vertex(mesh, i);
      EXPECT_NEAR((vertex(mesh, i + 1) - bottom).norm(), 0.3, 1e-6);
      EXPECT_GE(bottom.x(), tile.x);
      EXPECT_LE(bottom.x(), tile.x + 2.0);
      places.insert(bottom.y());
    }
  }
  EXPECT_GT(places.size(), 20u);  // of two tiles with the same rows there would be 16
}

// S2-14: strips are lifted from the ground; lying they are flat.
TEST(Strips, AreLiftedFromTheGround) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  for (const double grown : {0.0, 0.3, 1.0}) {
    GrassMesh mesh;
    appendStrips(map, tile, TileMotion(), grown, 800.0, mesh);
    EXPECT_NEAR(vertex(mesh, 1).z(), 0.3 * grown, 1e-6);
  }
}

// S2-19: wind displaces the tops of the strips as it does the blades: same side, same moment.
TEST(Strips, FollowTheWindOfTheBlades) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  TileMotion motion;
  motion.wind_x = {5.f, 5.f, 5.f, 5.f};
  motion.wind_y = {-2.f, -2.f, -2.f, -2.f};
  GrassMesh mesh;
  appendStrips(map, tile, motion, 1.0, 800.0, mesh);
  const Vec3 lean = vertex(mesh, 1) - vertex(mesh, 0);
  EXPECT_GT(lean.x(), 0.0);
  EXPECT_NEAR(lean.y() / lean.x(), -0.4, 1e-6);
  EXPECT_NEAR(lean.norm(), 0.3, 1e-6);
  Vec3 mean = Vec3::Zero();
  const auto blocks = posed(tile, motion, 1000);
  for (int i = 0; i < 1000; ++i)
    mean += (pointOf(blocks, i, LINKS) - pointOf(blocks, i, 0)) / traitsOf(tile, i).length;
  mean /= 1000.0;
  EXPECT_NEAR(lean.x() / 0.3, mean.x(), 0.03);  // the mean of bent blades against one sheet
  EXPECT_NEAR(lean.y() / 0.3, mean.y(), 0.03);
}

// S2-11, S2-W5: the density, one for all of a strip in the paper, may differ from vertex to vertex.
TEST(Strips, CarryTheDensityAsAlpha) {
  const FeatureMap map;
  Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  tile.density = {0.f, 400.f, 200.f, 800.f};
  GrassMesh mesh;
  appendStrips(map, tile, TileMotion(), 1.0, 800.0, mesh);
  EXPECT_EQ(mesh.colours[3], 0);
  EXPECT_EQ(mesh.colours[4 * 2 * STRIP_CELLS + 3], 128);  // the south-east corner
}

// S2-10: a test against alpha shows as many blades of the picture as the density asks for.
TEST(StripPicture, ShowsAsManyBladesAsTheDensityAsksFor) {
  constexpr int BLADES = 50;
  const StripPicture picture = makeStripPicture(256, 128, BLADES, 3);
  ASSERT_EQ(picture.pixels.size(), 256u * 128u * 4u);
  std::size_t before = 0;
  for (const double density : {0.1, 0.3, 0.5, 0.8, 1.0}) {
    std::set<int> visible;
    std::size_t pixels = 0;
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
      if (picture.pixels[i] > 255.0 * (1.0 - density)) {
        visible.insert(picture.pixels[i]);
        ++pixels;
      }
    EXPECT_NEAR(static_cast<double>(visible.size()), BLADES * density, 2.0);
    EXPECT_GT(pixels, before);
    before = pixels;
  }
}

// S2-W3: layers lie over each other up to the top of the grass; the higher the more displaced.
TEST(Layers, LieOverEachOtherAndShearWithTheWind) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  TileMotion motion;
  motion.wind_x = {5.f, 5.f, 5.f, 5.f};
  GrassMesh mesh;
  appendLayers(map, tile, motion, 6, 1.0, 800.0, mesh);
  expectSound(mesh);
  EXPECT_EQ(mesh.vertexCount(), 24u);
  double height = 0.0, shift = 0.0;
  for (std::size_t layer = 0; layer < 6; ++layer) {
    const Vec3 corner = vertex(mesh, 4 * layer);
    EXPECT_GT(corner.z(), height);
    EXPECT_GT(corner.x() - tile.x, shift);
    for (std::size_t k = 1; k < 4; ++k)
      EXPECT_NEAR(vertex(mesh, 4 * layer + k).z(), corner.z(), 1e-6);
    height = corner.z();
    shift = corner.x() - tile.x;
  }
  EXPECT_LT(height, 0.3);
}

// S2-W3: from above the lowest layer shows all blades, however many layers there are.
TEST(Layers, CoverTheGroundEquallyForEveryCount) {
  const FeatureMap map;
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  for (const int layers : {1, 3, MOST_LAYERS}) {
    GrassMesh mesh;
    appendLayers(map, tile, TileMotion(), layers, 1.0, map.at(5.0, 5.0).density, mesh);
    EXPECT_EQ(mesh.colours[3], 255) << layers;
    EXPECT_EQ(mesh.indices.size(), 6u * static_cast<std::size_t>(layers));
  }
}

/// Returns red over green, summed over the areas of triangles.
double rednessOf(const GrassMesh& mesh) {
  double red = 0.0, green = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::size_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    const double area =
        (vertex(mesh, b) - vertex(mesh, a)).cross(vertex(mesh, c) - vertex(mesh, a)).norm();
    for (const std::size_t k : {a, b, c}) {
      red += area * mesh.colours[4 * k];
      green += area * mesh.colours[4 * k + 1];
    }
  }
  return red / green;
}

// S2-18: strips, layers and ground keep the colour of flowers that can no longer be distinguished.
TEST(FarColour, KeepsTheColourOfFlowers) {
  MapInput input;
  input.species.resize(2);
  input.species[1].species.name = "poppy";
  input.species[1].species.flower_radius = 0.03;
  input.species[1].species.flower_colour = Vec3(0.8, 0.1, 0.1);
  input.species[1].mix.value = 0.3;
  const FeatureMap map(input);
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 2, 2);
  const auto blocks = posed(tile, TileMotion(), tile.blades);
  RibbonStyle style;
  style.eye = Vec3(tile.x - 20.0, tile.y + 1.0, 1.6);
  GrassMesh blades, strips, layers;
  appendRibbons(map, tile, blocks.data(), tile.blades, style, blades);
  appendStrips(map, tile, TileMotion(), 1.0, 1000.0, strips);
  appendLayers(map, tile, TileMotion(), 4, 1.0, 1000.0, layers);
  const Vec3 green = meanColour(map, map.at(5.0, 5.0));
  const double near = rednessOf(blades), leaves = green.x() / green.y();
  EXPECT_GT(near, leaves + 0.2);
  for (const double far : {rednessOf(strips), rednessOf(layers)})
    EXPECT_NEAR(far, near, 0.35 * (near - leaves)) << near << ' ' << leaves;
  const std::vector<std::uint8_t> ground = groundColours(map, 1000.0);
  EXPECT_GT(double{1} * ground[0] / ground[1], leaves + 0.1);
}

// S2-13: the ground has a colour everywhere: soil where nothing grows.
TEST(GroundColours, AreSoilWhereNothingGrowsAndGrassWhereItIsDense) {
  MapInput input;
  input.density = {0.0, {2, 2, 1, {0, 0, 0, 1}}, 0.0, 1000.0};
  const FeatureMap map(input);
  const auto colours = groundColours(map, 800.0);
  ASSERT_EQ(colours.size(), 12u);
  EXPECT_GT(colours[0], colours[1]);  // brown in the south-west
  EXPECT_GT(colours[4], colours[3]);  // green in the south-east
}

// S2-03, fig. 2: height and colour of the map are seen on the blades.
TEST(Ribbons, ShowColourAndHeightOfTheMap) {
  MapInput input;
  input.colour = {0.0, {2, 2, 1, {0, 1, 0, 1}}, 0.0, 1.0};
  input.height = {0.0, {2, 2, 1, {0, 1, 0, 1}}, 0.1, 0.5};
  const FeatureMap map(input);
  const Tile tile = makeTile(map, terrain::HeightMap(), 1, 0, 0);
  double red[2] = {}, length[2] = {}, count[2] = {};
  const auto blocks = posed(tile, TileMotion(), 800);
  GrassMesh mesh;
  appendRibbons(map, tile, blocks.data(), 800, RibbonStyle(), mesh);
  for (int i = 0; i < 800; ++i) {
    const BladeTraits look = traitsOf(tile, i);
    const int side = look.u > 0.5f;
    red[side] += mesh.colours[static_cast<std::size_t>(4 * (11 * i + 10))];
    length[side] += double{look.length};
    count[side] += 1.0;
  }
  EXPECT_GT(red[1] / count[1], 1.3 * red[0] / count[0]);
  EXPECT_GT(length[1] / count[1], 1.5 * length[0] / count[0]);
}

}  // namespace
}  // namespace vegetation_sim::grass
