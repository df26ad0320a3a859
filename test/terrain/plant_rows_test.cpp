// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/plant_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace vegetation_sim::terrain {
namespace {

constexpr double EXACTLY = 1e-9;  // [m] of sums of some tens of metres

std::vector<RowPlant> plantsOf(const std::string& keys, const HeightMap& ground = HeightMap(),
                               std::uint64_t seed = 1) {
  Faults faults;
  YamlSection section(parseYaml("{" + keys + "}", "rows"), "rows", faults);
  const RowLaw law = readRowLaw(section);
  section.finish();
  std::vector<RowPlant> out = placeInRows(law, ground, seed, MOST_ROW_PLANTS, section);
  EXPECT_EQ(faults.text(), "");
  return out;
}

std::string faultsOf(const std::string& keys, int most = MOST_ROW_PLANTS) {
  Faults faults;
  YamlSection section(parseYaml("{" + keys + "}", "rows"), "rows", faults);
  const RowLaw law = readRowLaw(section);
  section.finish();
  if (faults.empty()) placeInRows(law, HeightMap(), 1, most, section);
  return faults.text();
}

std::map<std::pair<int, int>, RowPlant> byPlace(const std::vector<RowPlant>& plants) {
  std::map<std::pair<int, int>, RowPlant> out;
  for (const RowPlant& plant : plants) out[{plant.row, plant.place}] = plant;
  return out;
}

void expectEqual(const RowPlant& a, const RowPlant& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.yaw, b.yaw);
  EXPECT_EQ(a.scale, b.scale);
  EXPECT_EQ(a.seed, b.seed);
}

// A plane that rises by `grade` per metre to the east, and by half of it to the north.
HeightMap plane(double grade) {
  HeightMapLaw law;
  law.resolution = 100.0;
  law.origin = Vec3(-50.0, -50.0, 0.0);
  law.height_max = 150.0 * grade;
  return HeightMap(law, {2, 2, 6, {2, 6, 0, 4}});  // in units of 25 m * grade
}

TEST(PlantRows, StandAtTheFormula) {
  const double turn = 0.7, c = std::cos(turn), s = std::sin(turn);
  const auto plants = plantsOf(
      "origin: [3, -2, 0.1], heading: 0.7, row_spacing: 2.5, plant_spacing: 0.4, rows: 4,"
      "plants: 6, headland: 1.5, turn: 0, smallest: 1, largest: 1");
  ASSERT_EQ(plants.size(), 24U);
  for (std::size_t i = 0; i < plants.size(); ++i) {
    const RowPlant& plant = plants[i];
    EXPECT_EQ(plant.row, static_cast<int>(i) / 6);
    EXPECT_EQ(plant.place, static_cast<int>(i) % 6);
    const double t = 1.5 + 0.4 * plant.place, w = 2.5 * plant.row;
    EXPECT_NEAR(plant.position.x(), 3.0 + c * t - s * w, EXACTLY);
    EXPECT_NEAR(plant.position.y(), -2.0 + s * t + c * w, EXACTLY);
    EXPECT_EQ(plant.position.z(), 0.1);
    EXPECT_EQ(plant.yaw, 0.7);
    EXPECT_EQ(plant.scale, 1.0);
  }
}

// 10 m across hold rows at 0, 2.5 ... 10 m; 6 m along without 0.75 m at both ends hold 10 plants.
TEST(PlantRows, FillAnExtentBetweenItsHeadlands) {
  const auto plants =
      plantsOf("width: 10, length: 6, row_spacing: 2.5, plant_spacing: 0.5, headland: 0.75");
  ASSERT_EQ(plants.size(), 5U * 10U);
  for (const RowPlant& plant : plants) {
    EXPECT_GE(plant.position.x(), 0.75 - EXACTLY);
    EXPECT_LE(plant.position.x(), 5.25 + EXACTLY);
  }
  EXPECT_NEAR(plants.back().position.x(), 5.25, EXACTLY);
  EXPECT_NEAR(plants.back().position.y(), 10.0, EXACTLY);
}

TEST(PlantRows, HaveTheirShareOfGaps) {
  const auto plants = plantsOf("rows: 100, plants: 100, gaps: 0.2");
  EXPECT_NEAR(static_cast<double>(plants.size()), 8000.0, 160.0);  // 4 sigma of a binomial
  EXPECT_TRUE(plantsOf("rows: 10, plants: 10, gaps: 1").empty());
}

TEST(PlantRows, KeepAllOtherPlantsIfGapsRowsAndSpacingChange) {
  const std::string law = "jitter_along: 0.1, jitter_across: 0.1, plant_spacing: 0.5, ";
  const auto all = byPlace(plantsOf(law + "rows: 20, plants: 30"));
  for (const char* keys :
       {"rows: 20, plants: 30, gaps: 0.3", "rows: 7, plants: 30", "rows: 20, plants: 11"}) {
    const auto fewer = plantsOf(law + keys);
    EXPECT_LT(fewer.size(), all.size());
    for (const RowPlant& plant : fewer) expectEqual(plant, all.at({plant.row, plant.place}));
  }
  // Another spacing moves plants, which stay the same individuals.
  for (const RowPlant& plant : plantsOf("rows: 20, plants: 30, plant_spacing: 0.6"))
    EXPECT_EQ(plant.seed, all.at({plant.row, plant.place}).seed);
  // More gaps keep the gaps that were there.
  const auto few = byPlace(plantsOf(law + "rows: 20, plants: 30, gaps: 0.1"));
  for (const RowPlant& plant : plantsOf(law + "rows: 20, plants: 30, gaps: 0.3"))
    EXPECT_EQ(few.count({plant.row, plant.place}), 1U);
}

TEST(PlantRows, ArePureFunctionsOfTheSeed) {
  const std::string law = "rows: 5, plants: 5, jitter_along: 0.2";
  const auto first = plantsOf(law), again = plantsOf(law), other = plantsOf(law, HeightMap(), 2);
  for (std::size_t i = 0; i < first.size(); ++i) {
    expectEqual(first[i], again[i]);
    EXPECT_NE(first[i].seed, other[i].seed);
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(first[i].seed, first[j].seed);
  }
}

TEST(PlantRows, JitterTurnAndScaleWithinTheirBounds) {
  const auto plants = plantsOf(
      "rows: 40, plants: 50, jitter_along: 0.2, jitter_across: 0.05, turn: 0.3, smallest: 0.8,"
      "largest: 1.5");
  double along = 0.0, across = 0.0, turn = 0.0, smallest = 2.0, largest = 0.0;
  for (const RowPlant& plant : plants) {
    along = std::max(along, std::fabs(plant.position.x() - 1.0 * plant.place));
    across = std::max(across, std::fabs(plant.position.y() - 2.0 * plant.row));
    turn = std::max(turn, std::fabs(plant.yaw));
    smallest = std::min(smallest, plant.scale);
    largest = std::max(largest, plant.scale);
  }
  const auto fills = [](double value, double bound) {
    return value <= bound && value > 0.98 * bound;
  };
  EXPECT_TRUE(fills(along, 0.2 + EXACTLY)) << along;
  EXPECT_TRUE(fills(across, 0.05 + EXACTLY)) << across;
  EXPECT_TRUE(fills(turn, 0.3)) << turn;
  EXPECT_NEAR(smallest, 0.8, 0.01);
  EXPECT_NEAR(largest, 1.5, 0.01);
}

// Compares with all places of the grid.
TEST(PlantRows, FillAPolygonWithoutItsHeadlands) {
  // A triangle whose row at y = w reaches from x = -w to x = 20 - w.
  const auto plants = plantsOf(
      "row_spacing: 1.5, plant_spacing: 0.7, headland: 1,"
      "polygon: [{x: 8, y: -8}, {x: 28, y: -8}, {x: 12, y: 8}, {x: -8, y: 8}]");
  const auto found = byPlace(plants);
  EXPECT_EQ(found.size(), plants.size());
  std::size_t inside = 0;
  for (int row = -20; row <= 20; ++row) {
    for (int place = -60; place <= 60; ++place) {
      const double x = 0.7 * place, y = 1.5 * row;
      const double from_edge = std::min(x + y, 20.0 - x - y) - 1.0;
      const bool expected = std::fabs(y) < 8.0 && from_edge > -EXACTLY;
      ASSERT_EQ(found.count({row, place}), expected ? 1U : 0U) << row << ", " << place;
      if (!expected) continue;
      ++inside;
      EXPECT_NEAR(found.at({row, place}).position.x(), x, EXACTLY);
      EXPECT_NEAR(found.at({row, place}).position.y(), y, EXACTLY);
    }
  }
  EXPECT_EQ(inside, plants.size());
}

// A row that crosses a bay of the field ends before it and begins anew behind it.
TEST(PlantRows, LeaveABayOfAConcavePolygonFree) {
  const auto plants = plantsOf(
      "plant_spacing: 0.5, row_spacing: 1, headland: 0.5, polygon: [{x: 0, y: -2}, {x: 30, y: -2},"
      "{x: 30, y: 10}, {x: 20, y: 10}, {x: 20, y: 3}, {x: 10, y: 3}, {x: 10, y: 10}, {x: 0, y: "
      "10}]");
  int beside = 0;
  for (const RowPlant& plant : plants) {
    const double x = plant.position.x(), y = plant.position.y();
    EXPECT_FALSE(y > 3.0 && x > 9.5 + EXACTLY && x < 20.5 - EXACTLY) << x << ", " << y;
    beside += y > 3.0 && x > 20.0;
  }
  EXPECT_EQ(beside, 6 * 19);  // rows at 4 to 9 m, not on the upper edge; plants at 20.5 to 29.5 m
}

TEST(PlantRows, KeepTheirPlantsIfAnEdgeOfThePolygonMoves) {
  const std::string law = "jitter_along: 0.1, gaps: 0.1, heading: 0.5, polygon: ";
  const auto large = byPlace(
      plantsOf(law + "[{x: -20, y: -20}, {x: 20, y: -20}, {x: 20, y: 20}, {x: -20, y: 20}]"));
  const auto small =
      plantsOf(law + "[{x: -20, y: -20}, {x: 11, y: -20}, {x: 20, y: 13}, {x: -20, y: 20}]");
  EXPECT_LT(small.size(), large.size());
  for (const RowPlant& plant : small) expectEqual(plant, large.at({plant.row, plant.place}));
}

// On a plane the straight distance is the horizontal one times sqrt(1 + grade^2).
TEST(PlantRows, AreSpacedAlongASlopeOrOnTheMap) {
  const double grade = 0.4;
  const HeightMap ground = plane(grade);
  const auto standing = [&](const RowPlant& plant) {
    Vec3 out = plant.position;
    out.z() += ground.height(out.x(), out.y());
    return out;
  };
  const std::string law = "row_spacing: 2, plant_spacing: 0.5, rows: 5, plants: 20, ";
  const auto slope = plantsOf(law + "spacing: slope", ground);
  const auto map = plantsOf(law + "spacing: horizontal", ground);
  ASSERT_EQ(slope.size(), 100U);
  for (std::size_t i = 1; i < 20; ++i) {
    EXPECT_NEAR(length(Vec3(standing(slope[i]) - standing(slope[i - 1]))), 0.5, EXACTLY);
    EXPECT_NEAR(slope[i].position.x(),
                0.5 * static_cast<double>(i) / std::sqrt(1.0 + grade * grade), EXACTLY);
    EXPECT_NEAR(map[i].position.x(), 0.5 * static_cast<double>(i), EXACTLY);
  }
  for (std::size_t row = 1; row < 5; ++row)
    EXPECT_NEAR(length(Vec3(standing(slope[20 * row]) - standing(slope[20 * row - 20]))), 2.0,
                EXACTLY);
}

TEST(PlantRows, AreSpacedAlongASlopeInsideAPolygonToo) {
  const HeightMap ground = plane(0.4);
  const double step = 0.5 / std::sqrt(1.16), across = 2.0 / std::sqrt(1.04);
  const auto plants = plantsOf(
      "row_spacing: 2, plant_spacing: 0.5, spacing: slope,"
      "polygon: [{x: -9, y: -7}, {x: 9, y: -7}, {x: 9, y: 7}, {x: -9, y: 7}]",
      ground);
  EXPECT_EQ(plants.size(), 7U * 39U);
  for (const RowPlant& plant : plants) {
    EXPECT_NEAR(plant.position.x(), step * plant.place, EXACTLY);
    EXPECT_NEAR(plant.position.y(), across * plant.row, EXACTLY);
  }
}

class RowFault : public testing::TestWithParam<std::pair<const char*, const char*>> {};
TEST_P(RowFault, NamesKeyValueAndRange) {
  const std::string text = faultsOf(GetParam().first);
  EXPECT_NE(text.find(GetParam().second), std::string::npos) << text;
}
INSTANTIATE_TEST_SUITE_P(
    PlantRows, RowFault,
    testing::Values(
        std::pair("origin: [2e6, 0, 0]", "rows: origin[0] = 2e+06 m is outside -1e+06 to 1e+06 m"),
        std::pair("heading: 2000", "heading = 2000 rad is outside -1000 to 1000 rad"),
        std::pair("row_spacing: 0", "row_spacing = 0 m is outside 0.05 to 1000 m"),
        std::pair("plant_spacing: 0.001", "plant_spacing = 0.001 m is outside 0.01 to 1000 m"),
        std::pair("spacing: steep", "spacing = 'steep' is none of horizontal, slope"),
        std::pair("rows: 0", "rows = 0 is outside 1 to 65536"),
        std::pair("plants: 70000", "plants = 70000 is outside 1 to 65536"),
        std::pair("width: -1", "width = -1 m is outside 0 to 100000 m"),
        std::pair("length: .nan", "length = nan m is not finite"),
        std::pair("headland: -1", "headland = -1 m is outside 0 to 1000 m"),
        std::pair("gaps: 1.5", "gaps = 1.5 is outside 0 to 1"),
        std::pair("jitter_along: -1", "jitter_along = -1 m is outside 0 to 100 m"),
        std::pair("jitter_across: 101", "jitter_across = 101 m is outside 0 to 100 m"),
        std::pair("turn: 4", "turn = 4 rad is outside 0 to 3.1416 rad"),
        std::pair("smallest: 0", "smallest = 0 is outside 0.05 to 20"),
        std::pair("largest: 21", "largest = 21 is outside 0.05 to 20"),
        std::pair("smallest: 2", "largest = 1.1 is outside 2 to 20"),
        std::pair("rows: 3, width: 5", "rows and width are both given; only one is allowed"),
        std::pair("plants: 3, length: 5", "plants and length are both given"),
        std::pair("rows: 3, polygon: [{x: 0}, {x: 1}, {x: 1, y: 1}]",
                  "rows and polygon are both given; only one is allowed"),
        std::pair("length: 3, polygon: [{x: 0}, {x: 1}, {x: 1, y: 1}]",
                  "length and polygon are both given"),
        std::pair("polygon: [{x: 0}, {x: 1}]", "polygon has 2 corners; allowed are 3 to 64"),
        std::pair("polygon: [{x: 0}, {x: 1}, {x: 1, y: 1e9}]",
                  "polygon[2]: y = 1e+09 m is outside"),
        std::pair("polygon: 7", "polygon = '7' is not a list"),
        std::pair("spaces: 7", "spaces is not a known key"),
        std::pair("rows: 300, plants: 300", "has 90000 plants in its rows; allowed are 0 to 65536"),
        std::pair("width: 1e5, length: 1e5",
                  "has more than 1048576 places in its rows; allowed are 0 to 1048576")));

TEST(PlantRows, NameTheRoomThatALayoutHasLeft) {
  EXPECT_EQ(faultsOf("rows: 5, plants: 4", 20), "");
  EXPECT_EQ(faultsOf("rows: 5, plants: 5", 20),
            "rows: has 25 plants in its rows; allowed are 0 to 20");
}

}  // namespace
}  // namespace vegetation_sim::terrain
