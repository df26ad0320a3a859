// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/ros/conversions/grass_conversions.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error_text.h"
#include "scenes/grass/tread_simulation_fixture.h"

namespace vegetation_sim {
namespace {

constexpr double GRASS_NAN = std::numeric_limits<double>::quiet_NaN();

/// Returns a layout with a different value in every field and images of one and two bytes per
/// sample.
grass::Layout exampleMeadow() {
  grass::MapInput map;
  map.law = {1.5, -3.0, 4.0, 3, 2};
  map.density.image = {3, 2, 255, {0, 100, 200, 50, 150, 255}};
  map.height.image = {3, 2, 65535, {0, 1000, 20000, 50, 65535, 255}};
  map.height.white = 0.7;
  map.colour.value = 0.25;
  map.species.resize(2);
  map.species[0].species.name = "fescue";
  map.species[1].species.name = "poppy";
  map.species[1].species.flower_radius = 0.03;
  map.species[1].species.colour = Vec3(0.1, 1.0 / 3.0, 0.5);
  map.species[1].mix.value = 0.1;
  grass::Layout out;
  out.map = std::make_shared<const grass::FeatureMap>(map);
  out.seed = 18446744073709551615ULL;
  out.terrain = "package://somewhere/hills.yaml";
  out.terrain_hash = 7;
  out.blade_model = grass::BladeModel::PAPER;
  out.tread_spacing = 0.0625;
  out.tread = {0.2, 0.5, 0.15, 0.7, 90.0};
  return out;
}

TEST(GrassConversions, ReturnEveryFieldOfALayout) {  // S2-03, S2-W2
  const grass::Layout layout = exampleMeadow();
  const grass::Layout back = fromMsg(toMsg(layout));
  EXPECT_EQ(back.hash(), layout.hash());  // the hash covers every number
  EXPECT_EQ(back.terrain, layout.terrain);
  EXPECT_EQ(back.map->hash(), layout.map->hash());
  EXPECT_EQ(toMsg(layout).blade_model, "paper");
  EXPECT_EQ(back.map->node(1, 1).density, layout.map->node(1, 1).density);
  EXPECT_EQ(back.map->node(1, 0).height, layout.map->node(1, 0).height);
}

TEST(GrassConversions, RefuseALayoutWithAllItsFaults) {
  GrassLayout message = toMsg(exampleMeadow());
  message.blade_model = "rubber";
  message.density.samples.pop_back();
  message.species[1].rules = "{width: -1, hieght: 4}";
  message.tread.load = -1.0;
  message.tread_spacing = GRASS_NAN;
  const std::string faults = errorOf([&] { fromMsg(message); });
  for (const char* part :
       {"blade_model = 'rubber' is none of arc, paper", "density: 5 bytes for 3 x 2 samples of 1",
        "species 'poppy': width = -1 m", "hieght is not a known key", "tread: load = -1",
        "tread_spacing = nan"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

TEST(GrassConversions, RefuseLongNamesAndRules) {
  GrassLayout message = toMsg(exampleMeadow());
  message.species[1].name = std::string(257, 'n');
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "layout: species " + inQuotes(message.species[1].name) +
                ": name has 257 letters, more than the 256 allowed");
  message.species[1].name = "poppy";
  message.species[0].rules = message.species[1].rules = std::string((1 << 19) + 1, ' ');
  EXPECT_EQ(errorOf([&] { fromMsg(message); }),
            "layout: species: rules have 1048578 bytes together, more than the 1048576 allowed");
}

TEST(GrassConversions, RefuseALayoutOfAnotherHash) {
  GrassLayout message = toMsg(exampleMeadow());
  message.colour.value = 0.26;
  EXPECT_NE(errorOf([&] { fromMsg(message); }).find("is not that of its content"),
            std::string::npos);
}

class GrassStateConversions : public grass::FieldTest {};

TEST_F(GrassStateConversions, ReturnTroddenGroundToTheBit) {
  drive("a", 3.0, 5.0, 1.0, 40);
  const grass::TreadUpdate update = field_.update(true);
  const GrassState message = toMsg(update);
  const grass::TreadUpdate back = fromMsg(message);
  EXPECT_EQ(hashOf(back.treads), update.hash);
  EXPECT_EQ(message.hash, update.hash);
  EXPECT_EQ(back.stamp, update.stamp);
  EXPECT_EQ(back.sequence, update.sequence);
  EXPECT_TRUE(back.key_frame);
  EXPECT_EQ(back.layout_hash, layout_.hash());
}

TEST_F(GrassStateConversions, ReturnCutGroundToTheBit) {
  grass::CutArea area;
  area.outline = {{3.0, 3.0}, {6.0, 3.0}, {5.0, 7.0}};
  area.swath = {{3.0, 3.0}, {4.0, 3.0}, {4.0, 4.0}};
  const grass::CutArea same = fromMsg(toMsg(area), "");
  EXPECT_EQ(same.outline[2].y, 7.0);
  EXPECT_EQ(same.swath[2].x, 4.0);
  EXPECT_EQ(same.height, area.height);
  field_.cut(area);
  const grass::TreadUpdate update = field_.update(true);
  GrassState message = toMsg(update);
  EXPECT_FALSE(message.cuts.empty());
  EXPECT_EQ(hashOf(fromMsg(message).treads), update.hash);
  message.cuts[0].height[0] = -1.f;
  EXPECT_NE(errorOf([&] { fromMsg(message); }).find("height = -1 m is outside 0 to"),
            std::string::npos);
  message.cuts[0].height.pop_back();
  EXPECT_NE(errorOf([&] { fromMsg(message); }).find("its lists differ in length"),
            std::string::npos);
}

TEST_F(GrassStateConversions, RejectInvalidStates) {
  drive("a", 3.0, 5.0, 1.0, 5);
  GrassState message = toMsg(field_.update(true));
  GrassState lists = message, presses = message, nodes = message;
  lists.blocks[0].x.pop_back();
  EXPECT_NE(errorOf([&] { fromMsg(lists); }).find("its lists differ in length"), std::string::npos);
  presses.press_recoveries.pop_back();
  EXPECT_NE(errorOf([&] { fromMsg(presses); }).find("press_stamps for"), std::string::npos);
  nodes.blocks[0].press[0] = 77;
  EXPECT_NE(errorOf([&] { fromMsg(nodes); }).find("press = 77"), std::string::npos);
}

// S2-18: as a message of their own, and in an event.
TEST(ColourConversions, ReturnEveryFieldOfTheDiscs) {
  grass::ColourMasks masks;
  masks.stamp = 7 * NANOSECONDS_PER_SECOND + 5;
  masks.list = {{{1.0, -2.0}, 3.0, 0.25, 4.0, {5.0, -6.0}}, {{-1.5, 2.5}, 0.5, 1.0, 100.0, {}}};
  const GrassColours message = toMsg(masks);
  const Nanoseconds later = masks.stamp + NANOSECONDS_PER_SECOND;
  const grass::ColourMasks back = fromMsg(message), moved = masksOf(message.colours, later);
  EXPECT_EQ(back.stamp, masks.stamp);
  EXPECT_EQ(moved.stamp, later);
  for (const auto& list : {back.list, moved.list}) {
    ASSERT_EQ(list.size(), masks.list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      const grass::ColourMask &disc = list[i], &own = masks.list[i];
      EXPECT_EQ(disc.centre.x, own.centre.x);
      EXPECT_EQ(disc.centre.y, own.centre.y);
      EXPECT_EQ(disc.radius, own.radius);
      EXPECT_EQ(disc.colour, own.colour);
      EXPECT_EQ(disc.weight, own.weight);
      EXPECT_EQ(disc.velocity.x, own.velocity.x);
      EXPECT_EQ(disc.velocity.y, own.velocity.y);
    }
  }
}

TEST(ColourConversions, RefuseDiscsWithAllTheirFaults) {
  std::vector<GrassColour> discs(2);
  discs[0].radius = 1.0;
  discs[0].colour = 1.5;
  discs[0].weight = -1.0;
  discs[1].x = 2e7;
  discs[1].velocity_y = GRASS_NAN;
  const std::string faults = errorOf([&] { masksOf(discs, 0); });
  for (const char* part :
       {"colours[0].colour = 1.5", "colours[0].weight = -1", "colours[1].x = 2e+07",
        "colours[1].radius = 0", "colours[1].velocity_y = nan"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
  GrassColour disc;
  disc.radius = 1.0;
  EXPECT_EQ(errorOf([&] { masksOf(std::vector<GrassColour>(257, disc), 0); }),
            "colours has 257 discs, allowed are 256");
}

TEST(TreadConversions, NumbersThatAreNotGivenAreThoseOfTheNode) {
  const grass::TreadLaw own{0.1, 0.3, 0.08, 0.9, 30.0};
  TreadEvent message;
  message.source = "wheel";
  message.position.x = 2.0;
  grass::TreadInput input = fromMsg(message, own, 0.4);
  EXPECT_EQ(input.law.radius, 0.1);
  EXPECT_EQ(input.law.recovery, 30.0);
  EXPECT_EQ(input.height_gate, 0.4);
  message.law.has_radius = message.law.has_load = message.has_height_gate = true;
  message.law.radius = 0.2;  // reach and softness grow in proportion
  input = fromMsg(message, own, 0.4);
  EXPECT_NEAR(input.law.reach, 0.6, 1e-12);
  EXPECT_NEAR(input.law.softness, 0.16, 1e-12);
  EXPECT_EQ(input.law.load, 0.0);  // a given 0 is no default
  EXPECT_EQ(input.height_gate, 0.0);
  EXPECT_FALSE(input.velocity.has_value());
  message.has_velocity = true;
  EXPECT_EQ(fromMsg(message, own, 0.4).velocity, Vec3(Vec3::Zero()));
  const grass::TreadInput back = fromMsg(toMsg(input), grass::TreadLaw(), 9.0);
  EXPECT_EQ(back.law.reach, input.law.reach);
  EXPECT_EQ(back.height_gate, input.height_gate);
  EXPECT_EQ(back.position, input.position);
}

TEST(TreadConversions, RejectEachInvalidField) {
  TreadEvent message;
  message.action = 9;
  message.position.y = GRASS_NAN;
  message.law.has_recovery = true;
  message.law.recovery = -1.0;
  message.law.softness = 0.5;
  message.velocity.x = 1.0;
  message.height_gate = 1.0;
  const std::string faults = errorOf([&] { fromMsg(message, grass::TreadLaw(), 0.3); });
  for (const char* part :
       {"source = '' has 0 letters", "action = 9", "position.y = nan", "recovery = -1 s",
        "softness = 0.5 needs has_softness = true", "velocity needs has_velocity = true",
        "height_gate = 1 needs has_height_gate = true"})
    EXPECT_NE(faults.find(part), std::string::npos) << part << " in " << faults;
}

}  // namespace
}  // namespace vegetation_sim
