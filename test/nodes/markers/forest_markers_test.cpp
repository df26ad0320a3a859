// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/markers/forest_markers.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t BRANCHES = 100000;  // capacity of the cache
constexpr int POINTS = 60000;

using visualization_msgs::Marker;

/// Action and number of points of the lists of bark and leaves.
struct Lists {
  std::vector<int> actions;
  std::vector<std::size_t> points;
};

/// A forest that nobody views, and its markers.
struct Drawing {
  explicit Drawing(forest::Layout layout)
      : forest(std::move(layout), forest::flatTerrain(), forest::Settings()) {}
  void setLayout(forest::Layout layout) {
    forest.setLayout(std::move(layout), forest::flatTerrain());
    cache.clear();
    markers.reset();
  }
  Lists build() {
    Lists out;
    markers.build({}, 0);
    for (const Marker& marker : markers.lists().message("map").markers) {
      EXPECT_EQ(marker.points.size(), marker.colors.size()) << marker.ns;
      out.actions.push_back(marker.action);
      out.points.push_back(marker.points.size());
    }
    return out;
  }
  forest::Forest forest;
  forest::TreeCache cache{BRANCHES};
  ForestMarkers markers{forest, cache, POINTS};
};

/// Returns a tree of a species without leaves.
forest::Layout bareTree() {
  forest::Layout out = forest::gridLayout(1, 10.0);
  for (forest::Species& species : out.species)
    for (forest::LimbRule& limb : species.limbs) limb.leaves = 0.0;
  return out;
}

const std::vector<int> BOTH{Marker::ADD, Marker::ADD}, NEITHER{Marker::DELETE, Marker::DELETE};
const std::vector<std::size_t> FULL{POINTS / 2, POINTS / 2}, EMPTY{0, 0};

// rviz draws triangles without area like others, so without trees there must be none. Trees that
// return are drawn in lists of the same length as before.
TEST(ForestMarkers, NoTreesAreNotDrawn) {
  Drawing drawing(forest::gridLayout(2, 10.0));
  for (int again = 0; again < 2; ++again) {
    const Lists drawn = drawing.build();
    EXPECT_EQ(drawn.actions, BOTH);
    EXPECT_EQ(drawn.points, FULL);
    EXPECT_GT(drawing.markers.lists().used(), 0u);
    drawing.setLayout(forest::gridLayout(0, 10.0));
    const Lists gone = drawing.build();
    EXPECT_EQ(gone.actions, NEITHER);
    EXPECT_EQ(gone.points, EMPTY);
    EXPECT_EQ(drawing.markers.lists().used(), 0u);
    drawing.setLayout(forest::gridLayout(2, 10.0));
  }
}

// Each list is handled on its own.
TEST(ForestMarkers, LeavesOfBareTreesAreNotDrawn) {
  const Lists drawn = Drawing(bareTree()).build();
  EXPECT_EQ(drawn.actions, (std::vector<int>{Marker::ADD, Marker::DELETE}));
  EXPECT_EQ(drawn.points, (std::vector<std::size_t>{POINTS / 2, 0}));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
