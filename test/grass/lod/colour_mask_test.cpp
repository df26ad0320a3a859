// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/lod/colour_mask.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::grass {
namespace {

// S2-18: colours are averaged by their weights, and fade to the edge of a disc.
TEST(ColourMask, AveragesColours) {
  const std::vector<ColourMask> masks{{{10, 0}, 5.0, 1.0, 1.0}, {{10, 0}, 2.0, 0.7, 2.0}};
  EXPECT_DOUBLE_EQ(averageColour(0.2, masks, 10.0, 0.0), (0.2 + 1.0 + 2.0 * 0.7) / 4.0);
  EXPECT_DOUBLE_EQ(averageColour(0.2, masks, 15.0, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(averageColour(0.2, {}, 10.0, 0.0), 0.2);
  double before = 1.0;
  for (double x = 12.0; x <= 15.0; x += 0.1) {
    const double here = averageColour(0.2, masks, x, 0.0);
    EXPECT_LE(here, before);
    before = here;
  }
}

// S2-18: discs move like other primitives.
TEST(ColourMask, MovesWithTime) {
  ColourMasks masks;
  masks.stamp = NANOSECONDS_PER_SECOND;
  masks.list = {{{0, 0}, 3.0, 1.0, 1.0, {2.0, -1.0}}};
  const ColourMask later = masks.at(4 * NANOSECONDS_PER_SECOND)[0];
  EXPECT_DOUBLE_EQ(later.centre.x, 6.0);
  EXPECT_DOUBLE_EQ(later.centre.y, -3.0);
  EXPECT_EQ(later.radius, 3.0);
}

TEST(ColourMask, IsReadFromAScenario) {
  Faults faults;
  YamlSection section(
      parseYaml("colours: [{x: 3, y: -4, radius: 6, colour: 0.5, velocity_x: 1}]", "meadow"),
      "meadow: grass", faults);
  const std::vector<ColourMask> masks = readColourMasks(section);
  section.finish();
  EXPECT_TRUE(faults.empty()) << faults.text();
  ASSERT_EQ(masks.size(), 1U);
  EXPECT_EQ(masks[0].centre.y, -4.0);
  EXPECT_EQ(masks[0].weight, 1.0);
  EXPECT_EQ(masks[0].velocity.x, 1.0);
}

TEST(ColourMask, RejectsInvalidDiscs) {
  Faults faults;
  ColourMasks masks;
  masks.list = {{{0, 0}, 0.0, 2.0, std::nan("")}};
  check(masks, faults);
  for (const char* text : {"colours[0].radius = 0 m is outside 0.1 to 10000",
                           "colours[0].colour = 2 is outside 0 to 1", "colours[0].weight = nan"})
    EXPECT_NE(faults.text().find(text), std::string::npos) << faults.text();
  Faults many;
  masks.list.assign(257, {});
  check(masks, many);
  EXPECT_NE(many.text().find("colours has 257 discs, allowed are 256"), std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim::grass
