// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/geometry_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "scenes/forest/forest_fixture.h"
#include "tree/mesh/bark_mesh.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::forest {
namespace {

// Returns the triangles of one oak by level.
const std::vector<double>& triangles() {
  static const std::vector<double> counts = [] {
    const Species species = shippedSpecies("oak");
    const Skeleton skeleton = grow(TreeSeed(), species);
    std::vector<double> out;
    for (int level = 0; level < GEOMETRY_LEVELS; ++level)
      out.push_back(
          static_cast<double>(buildMesh(skeleton, species, meshDetail(level)).triangleCount()));
    return out;
  }();
  return counts;
}

/// A forest as a display draws it: levels by projected size, with feedback of the complexity.
class DrawnForest {
 public:
  explicit DrawnForest(double scale, std::uint64_t trees = 256) {
    const Random random(42);
    for (std::uint64_t i = 0; i < trees; ++i)
      sizes_.push_back(scale * 10000.0 / random.uniform(i, 8.0, 150.0));
    levels_.assign(sizes_.size(), -1);
  }

  /// Draws a frame; returns its complexity.
  double frame(double target) {
    double out = 0.0;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      levels_[i] = geometryLevel(sizes_[i] * feedback_.factor(), levels_[i]);
      out += triangles()[static_cast<std::size_t>(levels_[i])];
    }
    feedback_.update(out, target);
    return out;
  }
  void approach(double factor) {
    for (double& size : sizes_) size *= factor;
  }
  /// Returns true if the complexity is within the step of one tree to its next level, or if no
  /// level helps any more.
  bool near(double drawn, double target) const {
    double most = 0.05 * target;
    bool last = true;
    for (const int level : levels_) {
      const auto i = static_cast<std::size_t>(level);
      const int end = drawn < target ? GEOMETRY_LEVELS - 1 : 0;
      last = last && level == end;
      if (level != end)
        most =
            std::max(most, std::fabs(triangles()[drawn < target ? i + 1 : i - 1] - triangles()[i]));
    }
    return last || std::fabs(drawn - target) <= most;
  }
  const std::vector<int>& levels() const { return levels_; }

 private:
  std::vector<double> sizes_;
  std::vector<int> levels_;
  ComplexityFeedback feedback_;
};

// S1-13: levels change at thresholds of the projected size, one after the other.
TEST(GeometryLevel, RisesWithProjectedSize) {
  int level = geometryLevel(1.0, -1);
  EXPECT_EQ(level, 0);
  for (double size = 1.0; size < 4000.0; size *= 1.01) {
    const int next = geometryLevel(size, -1);
    EXPECT_TRUE(next == level || next == level + 1) << size;
    level = next;
  }
  EXPECT_EQ(level, GEOMETRY_LEVELS - 1);
}

// S1-13: a level that crossed a border changes back only well beyond it.
TEST(GeometryLevel, HasHysteresis) {
  for (int level = 0; level + 1 < GEOMETRY_LEVELS; ++level) {
    double border = 1.0;
    while (geometryLevel(border, -1) <= level) border *= 1.001;
    EXPECT_EQ(geometryLevel(1.05 * border, level), level);
    EXPECT_EQ(geometryLevel(1.2 * border, level), level + 1);
    EXPECT_EQ(geometryLevel(0.95 * border, level + 1), level + 1);
    EXPECT_EQ(geometryLevel(0.8 * border, level + 1), level);
  }
}

TEST(GeometryLevel, DetailOutOfRangeIsTheNearestLevel) {
  EXPECT_EQ(meshDetail(-5).leaf_fraction, meshDetail(0).leaf_fraction);
  EXPECT_EQ(meshDetail(99).leaf_fraction, meshDetail(GEOMETRY_LEVELS - 1).leaf_fraction);
}

// S1-14: within 10 % of the target after 40 frames, from far too many or far too few triangles.
TEST(ComplexityFeedback, ReachesTheTarget) {
  for (const double scale : {0.05, 0.3, 1.0, 3.0, 8.0}) {
    for (const double target : {40000.0, 130000.0, 600000.0}) {
      DrawnForest forest(scale);
      double drawn = 0.0;
      for (int i = 0; i < 40; ++i) drawn = forest.frame(target);
      EXPECT_NEAR(drawn / target, 1.0, 0.1) << scale << " " << target;
    }
  }
}

// S1-14: no limit cycle: once there, no tree changes its level any more.
TEST(ComplexityFeedback, ComesToRest) {
  DrawnForest forest(1.0);
  for (int i = 0; i < 60; ++i) forest.frame(130000.0);
  const std::vector<int> levels = forest.levels();
  for (int i = 0; i < 200; ++i) {
    forest.frame(130000.0);
    ASSERT_EQ(forest.levels(), levels) << i;
  }
}

// S1-14: this also holds where the step of one tree is a large part of the target; the remaining
// distance is no larger than such a step.
TEST(ComplexityFeedback, ComesToRestInSmallForests) {
  for (const std::uint64_t trees : {1u, 4u, 16u, 40u}) {
    for (double target = 1000.0; target < 50000.0; target *= 1.13) {
      DrawnForest forest(1.0, trees);
      for (int i = 0; i < 500; ++i) forest.frame(target);
      const std::vector<int> levels = forest.levels();
      const double drawn = forest.frame(target);
      for (int i = 0; i < 1000; ++i) {
        forest.frame(target);
        ASSERT_EQ(forest.levels(), levels) << trees << " trees, " << target << ", frame " << i;
      }
      EXPECT_TRUE(forest.near(drawn, target)) << trees << " trees, " << drawn << " of " << target;
    }
  }
}

// S1-14: a settled factor changes again with the target or the scene.
TEST(ComplexityFeedback, WakesFromRest) {
  DrawnForest forest(1.0, 16);
  for (int i = 0; i < 500; ++i) forest.frame(9000.0);
  for (int i = 0; i < 60; ++i) forest.frame(60000.0);
  EXPECT_TRUE(forest.near(forest.frame(60000.0), 60000.0));
  for (int i = 0; i < 500; ++i) forest.frame(9000.0);
  forest.approach(3.0);
  for (int i = 0; i < 60; ++i) forest.frame(9000.0);
  EXPECT_TRUE(forest.near(forest.frame(9000.0), 9000.0));
}

// S1-14: it follows a scene that changes.
TEST(ComplexityFeedback, FollowsTheScene) {
  DrawnForest forest(1.0);
  for (int i = 0; i < 60; ++i) forest.frame(130000.0);
  forest.approach(3.0);
  double drawn = 0.0;
  for (int i = 0; i < 40; ++i) drawn = forest.frame(130000.0);
  EXPECT_NEAR(drawn, 130000.0, 13000.0);
}

// S1-14: where the complexity can only jump over the target, the factor settles instead of
// oscillating.
TEST(ComplexityFeedback, SettlesWhereTheTargetCannotBeMet) {
  ComplexityFeedback feedback;
  const auto jump = [&]() { return feedback.factor() > 1.37 ? 2000.0 : 500.0; };
  for (int i = 0; i < 60; ++i) feedback.update(jump(), 1000.0);
  double low = feedback.factor(), high = low;
  for (int i = 0; i < 200; ++i) {
    feedback.update(jump(), 1000.0);
    low = std::min(low, feedback.factor());
    high = std::max(high, feedback.factor());
  }
  EXPECT_LT(high / low, 1.02);
}

TEST(ComplexityFeedback, StaysInItsRange) {
  ComplexityFeedback feedback;
  for (int i = 0; i < 1000; ++i) feedback.update(0.0, 1e9);
  EXPECT_LE(feedback.factor(), 64.0);
  for (int i = 0; i < 1000; ++i) feedback.update(1e12, 1.0);
  EXPECT_GE(feedback.factor(), 1.0 / 64.0);
  feedback.reset();
  EXPECT_EQ(feedback.factor(), 1.0);
}

}  // namespace
}  // namespace vegetation_sim::forest
