// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/tread/cutter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/grass/tread_simulation_fixture.h"

namespace vegetation_sim::grass {
namespace {

constexpr double CELL = 0.05;

class CutterTest : public FieldTest {
 protected:
  static CutterPose pose(double x, double y, double yaw) {
    return {{x, y}, {std::cos(yaw), std::sin(yaw)}};
  }
  void drive(const Cutter& cutter, const std::vector<CutterPose>& way) {
    removed_ += field_.cut(footprintOf(cutter, way[0]));
    for (std::size_t i = 1; i < way.size(); ++i)
      for (const CutArea& area : sweep(cutter, way[i - 1], way[i])) removed_ += field_.cut(area);
  }
  bool isCut(double x, double y) const { return map_.cuts().at({x, y}).height < UNCUT; }
  double sumOf(double (*part)(const CutNode&)) const {
    double sum = 0.0;
    for (const auto& [place, block] : map_.cuts().state().blocks)
      for (const CutNode& node : block.nodes) sum += part(node);
    return sum * CELL * CELL;
  }
  double area() const {
    return sumOf([](const CutNode& node) { return node.height < UNCUT ? 1.0 : 0.0; });
  }
  double removed_{0.0};
};

// A fast mower leaves no gap: 10 m/s at 30 ticks a second moves by 0.33 m, its deck is 0.1 m long.
TEST_F(CutterTest, AFastMowerLeavesNoGap) {
  Cutter bar;
  bar.width = 1.2;
  bar.length = 0.1;
  const double yaw = 0.7, speed = 10.0 / 30.0;
  std::vector<CutterPose> way;
  for (int i = 0; i <= 30; ++i)
    way.push_back(pose(4.0 + speed * i * std::cos(yaw), 4.0 + speed * i * std::sin(yaw), yaw));
  drive(bar, way);
  const double length = 10.0 + 0.1, edge = 2.0 * (length + 1.2);
  EXPECT_NEAR(area(), 1.2 * length, 0.5 * CELL * edge);
  for (double s = 0.0; s <= 10.0; s += 0.02)
    for (double side = -0.56; side <= 0.57; side += 0.08)
      ASSERT_TRUE(isCut(4.0 + s * std::cos(yaw) - side * std::sin(yaw),
                        4.0 + s * std::sin(yaw) + side * std::cos(yaw)))
          << s << ", " << side;
}

TEST_F(CutterTest, ATurningDeckCutsARing) {
  Cutter deck;
  deck.width = 1.0;
  deck.length = 0.3;
  std::vector<CutterPose> way;
  for (int i = 0; i <= 12; ++i) {
    const double angle = i * 3.14159265358979 / 6.0;  // 30 degrees a tick
    way.push_back(
        pose(10.0 + 4.0 * std::cos(angle), 10.0 + 4.0 * std::sin(angle), angle + 1.5707963267949));
  }
  drive(deck, way);
  // A chord of 30 degrees leaves 0.14 m of the outer edge of the ring; the deck's corners reach
  // out.
  for (const double radius : {3.55, 4.0, 4.3})
    for (double angle = 0.0; angle < 6.28; angle += 0.01)
      ASSERT_TRUE(isCut(10.0 + radius * std::cos(angle), 10.0 + radius * std::sin(angle)));
  EXPECT_FALSE(isCut(10.0, 10.0));
  EXPECT_FALSE(isCut(10.0, 14.7));
}

TEST_F(CutterTest, ADiscSweepsACapsule) {
  Cutter disc;
  disc.shape = CutterShape::DISC;
  disc.width = 0.8;
  drive(disc, {pose(5.0, 5.0, 0.0), pose(9.0, 8.0, 0.0)});
  const double size = 3.14159265358979 * 0.16 + 0.8 * 5.0;
  EXPECT_NEAR(area(), size, 0.5 * CELL * (2.0 * 5.0 + 3.14159 * 0.8));
}

// The swath lies behind the deck, in its middle; the last one is one deck long.
TEST_F(CutterTest, TheSwathLiesBehindTheDeck) {
  Cutter deck;
  deck.width = 1.5;
  deck.length = 0.5;
  deck.swath_width = 0.6;
  std::vector<CutterPose> way;
  for (int i = 0; i <= 150; ++i) way.push_back(pose(5.0 + i / 30.0, 10.0, 0.0));
  drive(deck, way);
  const double laid = sumOf([](const CutNode& node) { return node.swath; });
  EXPECT_GT(removed_, 0.5);
  EXPECT_NEAR(laid, removed_, 1e-6 * removed_);
  EXPECT_EQ(map_.cuts().at({8.0, 10.4}).swath, 0.0);
  EXPECT_EQ(map_.cuts().at({9.95, 10.0}).swath, 0.0);  // below the deck
  // 1.5 m of grass on 0.6 m of swath.
  const double grass = massBelow(*layout_.map, layout_.map->at(8.0, 10.0), 1e9) -
                       massBelow(*layout_.map, layout_.map->at(8.0, 10.0), double{0.05f});
  double mean = 0.0;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 12; ++k)
      mean += map_.cuts().at({7.0 + CELL * i, 9.725 + CELL * k}).swath / 240.0;
  EXPECT_NEAR(mean, 2.5 * grass, 0.1 * 2.5 * grass);
}

TEST_F(CutterTest, AJumpOfTheHeadingCutsTheFootprintOnly) {
  EXPECT_EQ(sweep(Cutter(), pose(5.0, 5.0, 0.0), pose(15.0, 15.0, 3.0)).size(), 1u);
  drive(Cutter(), {pose(5.0, 5.0, 0.0), pose(15.0, 15.0, 3.0)});
  EXPECT_FALSE(isCut(10.0, 10.0));
  EXPECT_TRUE(isCut(15.0, 15.0));
}

}  // namespace
}  // namespace vegetation_sim::grass
