// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/crowd_markers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/crowd/crowd_scenes.h"

namespace vegetation_sim {
namespace {

constexpr Nanoseconds SECOND = NANOSECONDS_PER_SECOND;

/// People stand in a row away from a viewer, 2 m apart.
struct Row {
  explicit Row(int people) : crowd(1, {}, {-1, 5000, -5, 5}, crowd::flatGround()) {
    for (int i = 0; i < people; ++i)
      crowd::spawnAt(crowd, {2.0 + 2.0 * i, 0.0}, {2.0 + 2.0 * i, 1.0});
    viewer.position = Vec3(0.0, 0.0, 1.6);
  }
  TierAllocation build(int points, double tolerance, Nanoseconds stamp = 0) {
    CrowdMarkers markers(crowd, points, tolerance, crowd::ownStyles());
    markers.build({viewer}, stamp);
    EXPECT_EQ(markers.lists().message("map").markers[0].points.size(),
              static_cast<std::size_t>(points) / 3 * 3);
    EXPECT_EQ(static_cast<double>(markers.lists().used()), markers.balance().cost);
    return markers.balance();
  }
  crowd::Crowd crowd;
  Viewpoint viewer;
};

// N7: a person has the fewest facets that keep the tolerance.
TEST(CrowdMarkers, FarPeopleHaveFewerFacets) {
  Row row(200);
  const TierAllocation fine = row.build(400000, 1.0), coarse = row.build(400000, 4.0);
  EXPECT_EQ(fine.held_back, 0u);
  for (std::size_t tier = 1; tier < 5; ++tier) EXPECT_GT(fine.counts[tier], 0u) << tier;
  EXPECT_EQ(fine.counts[0], 0u);
  EXPECT_LT(coarse.cost, 0.9 * fine.cost);
  // Only people who stand nearer than the range of the finest tier are above the tolerance.
  EXPECT_LE(fine.over, 4u);
}

// rviz draws triangles without area like others, so without people there must be none.
TEST(CrowdMarkers, NothingIsDrawnWithoutPeople) {
  Row row(0);
  CrowdMarkers markers(row.crowd, 60000, 1.0, crowd::ownStyles());
  const auto marker = [&] {
    markers.build({row.viewer}, 0);
    return markers.lists().message("map").markers[0];
  };
  EXPECT_EQ(marker().action, visualization_msgs::Marker::DELETE);
  EXPECT_TRUE(marker().points.empty());
  crowd::spawnAt(row.crowd, {2.0, 0.0}, {2.0, 1.0});
  EXPECT_EQ(marker().action, visualization_msgs::Marker::ADD);
  EXPECT_EQ(marker().points.size(), 60000u);
}

// S2-35: a person who looks to the north holds the arms as the style says.
TEST(CrowdMarkers, BodiesHaveTheirStyles) {
  Row row(1);
  const auto reach = [&](const crowd::MotionStyles& styles) {
    CrowdMarkers markers(row.crowd, 60000, 1.0, styles);
    markers.build({row.viewer}, 0);
    const visualization_msgs::MarkerArray message = markers.lists().message("map");
    double out = 0.0;  // [m] to the north
    for (const geometry_msgs::Point& point : message.markers[0].points)
      out = std::max(out, point.y);
    return out;
  };
  EXPECT_GT(reach(crowd::armsToTheFront()), 0.55);
  EXPECT_LT(reach(crowd::ownStyles()), 0.45);
}

TEST(CrowdMarkers, ShardsHaveListsOfTheirOwn) {
  Row row(1);
  const auto name = [&](const Shard& shard) {
    CrowdMarkers markers(row.crowd, 60000, 1.0, crowd::ownStyles(), shard);
    markers.build({row.viewer}, 0);
    return markers.lists().message("map").markers[0].ns;
  };
  EXPECT_EQ(name({0, 1}), "people");
  EXPECT_EQ(name({0, 2}), "people_0");
  EXPECT_EQ(name({1, 2}), "people_1");
}

// N7: the limit of points applies. With a few points less some people are coarser; with half of the
// points some are left out.
TEST(CrowdMarkers, LimitOfPointsCoarsensPeopleBeforeAnyIsLeftOut) {
  Row row(200);
  const TierAllocation free = row.build(400000, 1.0);
  for (const double share : {0.95, 0.5}) {
    const int points = static_cast<int>(share * free.cost);
    const TierAllocation poor = row.build(points, 1.0);
    EXPECT_LE(poor.cost, points);
    EXPECT_GE(poor.cost, 0.9 * points);
    EXPECT_GT(poor.held_back, 0u);
    EXPECT_EQ(poor.counts[0] > 0, share < 0.9);
  }
}

// N7: a small move of the viewer does not change the tiers of people.
TEST(CrowdMarkers, TiersDoNotFlicker) {
  Row row(200);
  CrowdMarkers markers(row.crowd, 60000, 1.0, crowd::ownStyles());
  markers.build({row.viewer}, 0);
  const auto before = markers.balance().counts;
  for (int i = 1; i < 20; ++i) {
    row.viewer.position.x() = i % 2 ? 0.1 : 0.0;
    markers.build({row.viewer}, i * SECOND);
    EXPECT_EQ(markers.balance().counts, before) << i;
  }
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
