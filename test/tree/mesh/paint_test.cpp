// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/paint.h"

#include <gtest/gtest.h>

#include "scenes/forest/forest_fixture.h"

namespace vegetation_sim::forest {
namespace {

TEST(TreePaint, TwigsAndTrunksHaveTheirColours) {
  const Species birch = shippedSpecies("birch");
  const TreePaint paint(birch, 3);
  const Colour trunk = paint.bark(birch.trunk_radius), twig = paint.bark(birch.twig_radius);
  for (int i = 0; i < 3; ++i) {  // varied by at most a tenth from tree to tree
    EXPECT_NEAR(trunk[static_cast<std::size_t>(i)], birch.bark_colour[i], 0.1);
    EXPECT_NEAR(twig[static_cast<std::size_t>(i)], birch.twig_colour[i], 0.1);
  }
  EXPECT_GT(trunk[0], 2.f * twig[0]);
}

TEST(TreePaint, OuterLeavesAreYounger) {
  const TreePaint paint(shippedSpecies("oak"), 4);
  LeafCard inside, outside;
  inside.shade = 0.f;
  outside.shade = 1.f;
  EXPECT_LT(paint.leaf(inside)[1], paint.leaf(outside)[1]);
}

TEST(TreePaint, TreesOfASpeciesDifferALittle) {
  const Species oak = shippedSpecies("oak");
  LeafCard leaf;
  const Colour a = TreePaint(oak, 1).leaf(leaf), b = TreePaint(oak, 2).leaf(leaf);
  EXPECT_NE(a, b);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 0.15);
  EXPECT_EQ(a, TreePaint(oak, 1).leaf(leaf));
}

}  // namespace
}  // namespace vegetation_sim::forest
