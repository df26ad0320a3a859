// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/canopy_markers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {
namespace {

/// Shrubs stand in a row away from a viewer, 4 m apart.
struct Row {
  explicit Row(int shrubs) {
    layout.kinds.emplace_back();
    layout.kinds[0].leaves = 200;
    for (int i = 0; i < shrubs; ++i) {
      canopy::Plant plant;
      plant.seed = static_cast<std::uint64_t>(i);
      plant.position = Vec3(4.0 * (i + 1), 0.0, 0.0);
      layout.plants.push_back(plant);
    }
    viewer.position = Vec3(0.0, 0.0, 1.6);
  }
  /// Counts the points of leaves, which are away from the origin, in a list of constant size.
  TierAllocation build(int points, double tolerance) {
    canopy::Canopy canopy(layout);
    CanopyMarkers markers(canopy, crowns, forest, points, tolerance);
    markers.build({viewer}, 0);
    lists = markers.lists().message("map").markers;
    limit = markers.room();
    used = 0;
    for (const geometry_msgs::Point& p : lists[0].points) used += p.x != 0.0;
    return markers.balance();
  }
  canopy::Layout layout;
  Viewpoint viewer;
  LeafedCrowns crowns;
  forest::ForestReplica forest;
  std::vector<visualization_msgs::Marker> lists;
  std::size_t limit{0}, used{0};
};

// N7: a plant has the smallest share of its leaves that keeps the tolerance.
TEST(CanopyMarkers, FarPlantsHaveFewerLeaves) {
  Row row(40);
  const TierAllocation fine = row.build(200000, 1.0);
  EXPECT_EQ(row.lists[0].points.size(), row.limit);
  EXPECT_EQ(static_cast<double>(row.used), fine.cost);
  EXPECT_EQ(fine.held_back, 0u);
  const TierAllocation coarse = row.build(200000, 8.0);
  EXPECT_EQ(static_cast<double>(row.used), coarse.cost);
  EXPECT_LT(coarse.cost, 0.9 * fine.cost);
  EXPECT_EQ(coarse.over, 0u);
  EXPECT_EQ(coarse.counts[0], 0u);
}

// N7: the limit of points applies. Near plants keep more leaves, and far ones are thinned before
// any plant is left out.
TEST(CanopyMarkers, LimitOfPointsThinsPlantsBeforeAnyIsLeftOut) {
  Row row(40);
  const double free = row.build(200000, 1.0).cost;
  const TierAllocation poor = row.build(static_cast<int>(0.5 * free), 1.0);
  EXPECT_LE(poor.cost, static_cast<double>(row.limit));
  EXPECT_GE(poor.cost, 0.9 * static_cast<double>(row.limit));
  EXPECT_EQ(static_cast<double>(row.used), poor.cost);
  EXPECT_GT(poor.wanted, 0.9 * free);  // The shares of leaves differ.
  EXPECT_GT(poor.held_back, 0u);
  EXPECT_EQ(poor.counts[0], 0u);
}

// Leaves and stems lean with what a body has pushed, and stand again without it.
TEST(CanopyMarkers, PlantsLeanAwayFromABody) {
  Row row(2);
  canopy::Canopy canopy(row.layout);
  CanopyMarkers markers(canopy, row.crowns, row.forest, 20000, 1.0);
  Nanoseconds now = NANOSECONDS_PER_SECOND;
  const auto advance = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) canopy.advance(now += NANOSECONDS_PER_SECOND / 10);
    markers.build({row.viewer}, now);
    return markers.lists().message("map").markers;
  };
  const auto upright = advance(1);
  forest::Body ball;
  ball.id = "ball";
  ball.size.x() = 0.5;
  ball.pose.position = Vec3(3.6, 0.1, 0.9);
  ball.stamp = now;
  canopy.setBody(ball);
  const auto pushed = advance(20);
  for (const std::size_t list : {0, 1}) {
    ASSERT_EQ(pushed[list].points.size(), upright[list].points.size());
    double most = 0.0, other = 0.0;
    for (std::size_t i = 0; i < pushed[list].points.size(); ++i) {
      const geometry_msgs::Point &here = upright[list].points[i], &there = pushed[list].points[i];
      double& largest = here.x > 6.0 ? other : most;
      largest = std::max(largest, there.x - here.x);
    }
    EXPECT_GT(most, 0.05) << list;
    EXPECT_EQ(other, 0.0) << list;  // of the second shrub
  }
  canopy.removeBody("ball");
  const auto again = advance(300);
  for (const std::size_t list : {0, 1}) EXPECT_EQ(again[list].points, upright[list].points);
}

TEST(CanopyMarkers, WhatIsCutOffIsGone) {
  Row row(2);
  canopy::Canopy canopy(row.layout);
  CanopyMarkers markers(canopy, row.crowns, row.forest, 20000, 1.0);
  const auto build = [&] {
    markers.build({row.viewer}, 0);
    return markers.lists().message("map").markers;
  };
  // Returns the highest point of a plant in a list.
  const auto topOf = [](const visualization_msgs::Marker& list, bool second) {
    double out = 0.0;
    for (const geometry_msgs::Point& point : list.points)
      if ((point.x > 6.0) == second) out = std::max(out, point.z);
    return out;
  };
  const auto whole = build();
  canopy.cut({0}, 0.5);
  const auto cut = build();
  for (const std::size_t list : {0, 1}) {
    EXPECT_GT(topOf(whole[list], false), 1.2);
    EXPECT_GT(topOf(cut[list], false), 0.3);
    EXPECT_LT(topOf(cut[list], false), 0.6);  // leaves have a width
    EXPECT_EQ(topOf(cut[list], true), topOf(whole[list], true));
  }
  canopy.reset();
  const auto again = build();
  for (const std::size_t list : {0, 1, 2}) EXPECT_EQ(again[list].points, whole[list].points);
}

// Faces of a mesh that never move are stems and do not count as leaves.
TEST(CanopyMarkers, RigidFacesAreNotLeaves) {
  Row row(10);
  auto form = std::make_shared<canopy::Form>();
  form->leaves.resize(30);
  for (canopy::Leaf& leaf : form->leaves) leaf.root = leaf.tip = Vec3(0.1, 0.0, 0.5);
  form->rigid.resize(500);
  row.layout.kinds[0].shape = canopy::PlantShape::MESH;
  row.layout.kinds[0].file = "read.dae";
  row.layout.kinds[0].form = form;
  const TierAllocation balance = row.build(200000, 0.01);
  EXPECT_EQ(balance.cost, 10 * 30 * 6);
  EXPECT_EQ(static_cast<double>(row.used), balance.cost);
}

// rviz draws triangles without area like others, so without plants there must be none.
TEST(CanopyMarkers, NoPlantsAreNotDrawn) {
  using visualization_msgs::Marker;
  Row none(0), shrubs(4);
  none.build(60000, 1.0);
  for (const Marker& list : none.lists) {
    EXPECT_EQ(list.action, Marker::DELETE) << list.ns;
    EXPECT_TRUE(list.points.empty() && list.colors.empty()) << list.ns;
  }
  shrubs.build(60000, 1.0);
  for (const Marker& list : shrubs.lists) {
    EXPECT_EQ(list.action, Marker::ADD) << list.ns;
    EXPECT_EQ(list.points.size(), list.colors.size()) << list.ns;
  }
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
