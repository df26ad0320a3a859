// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/lod/tile_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vegetation_sim/core/lod/viewpoint.h"
#include "vegetation_sim/grass/blades/blade.h"

namespace vegetation_sim::grass {
namespace {

constexpr double TOLERANCE = 1.5;  // [pixel]
constexpr Nanoseconds TILE_START = 1700000000 * NANOSECONDS_PER_SECOND;

double scaleAt(double distance) {
  return pixelsPerMetre(Viewpoint(), distance);
}

// S2-15: nearer means finer, and each tier holds the tolerance where it is chosen.
TEST(TileModel, IsChosenByWhatItLeavesOutInPixels) {
  const TileDetail detail{0.03, 0.3};
  int before = 2;
  double first_strip = 0.0, first_texture = 0.0;
  for (double distance = 0.5; distance < 1000.0; distance *= 1.05) {
    const TileModel tier =
        chooseTileModel(detail, scaleAt(distance), TOLERANCE, TileModel::TEXTURE);
    EXPECT_LE(static_cast<int>(tier), before);
    if (tier == TileModel::STRIPS) {
      EXPECT_LE(detail.blade_spacing * scaleAt(distance), TOLERANCE);
    }
    if (tier == TileModel::TEXTURE) {
      EXPECT_LE(detail.height * scaleAt(distance), TOLERANCE);
    }
    if (tier == TileModel::STRIPS && first_strip == 0.0) first_strip = distance;
    if (tier == TileModel::TEXTURE && first_texture == 0.0) first_texture = distance;
    before = static_cast<int>(tier);
  }
  EXPECT_NEAR(first_strip, 20.0, 1.1);
  EXPECT_NEAR(first_texture, 200.0, 11.0);
}

// S2-15: a viewer who steps to and fro at a border does not make the tile flicker.
TEST(TileModel, HasHysteresis) {
  const TileDetail detail{0.03, 0.3};
  EXPECT_EQ(chooseTileModel(detail, scaleAt(21.0), TOLERANCE, TileModel::STRIPS),
            TileModel::STRIPS);
  EXPECT_EQ(chooseTileModel(detail, scaleAt(21.0), TOLERANCE, TileModel::BLADES),
            TileModel::BLADES);
  EXPECT_EQ(chooseTileModel(detail, scaleAt(29.0), TOLERANCE, TileModel::BLADES),
            TileModel::STRIPS);
  EXPECT_EQ(chooseTileModel(detail, scaleAt(1000.0), TOLERANCE, TileModel::BLADES),
            TileModel::TEXTURE);
  EXPECT_EQ(chooseTileModel(detail, scaleAt(19.0), TOLERANCE, TileModel::STRIPS),
            TileModel::BLADES);
}

// S2-08: five segments near, fewer with distance, never more again.
TEST(TileModel, SegmentsFallWithDistance) {
  EXPECT_EQ(bladeSegments(0.3, scaleAt(1.0), TOLERANCE), 5);
  int before = LINKS;
  for (double distance = 0.5; distance < 300.0; distance *= 1.1) {
    const int segments = bladeSegments(0.3, scaleAt(distance), TOLERANCE);
    EXPECT_LE(segments, before);
    before = segments;
  }
  EXPECT_EQ(before, 1);
}

// S2-08: the chords that are drawn are within the tolerance of the blade.
TEST(TileModel, SegmentsHoldTheTolerance) {
  for (double distance = 1.0; distance < 300.0; distance *= 1.1) {
    const int n = bladeSegments(0.3, scaleAt(distance), TOLERANCE);
    if (n == LINKS) continue;
    // An arc of 90 degrees: sagitta of a chord over 90 / n.
    const double radius = 0.3 / 1.5707963;
    const double sagitta = radius * (1.0 - std::cos(1.5707963 / (2.0 * n)));
    EXPECT_LE(sagitta * scaleAt(distance), TOLERANCE * 1.01) << distance;
  }
}

TEST(TileModel, ShareOfBladesFallsWithDistance) {
  const TileDetail detail{0.03, 0.3};
  EXPECT_EQ(bladeShare(detail, scaleAt(2.0), TOLERANCE), 1.0);
  EXPECT_EQ(bladeShare(detail, scaleAt(100.0), TOLERANCE), LEAST_SHARE);
  double before = 1.0;
  for (double distance = 0.5; distance < 100.0; distance *= 1.1) {
    const double share = bladeShare(detail, scaleAt(distance), TOLERANCE);
    EXPECT_LE(share, before);
    before = share;
  }
}

// S2-12, S2-14: at the ends all are blades, strips or flat; between them, monotone, without a jump.
TEST(Morph, LeadsFromBladesOverStripsToTheGround) {
  const Morph blades = morphAt(2.0), strips = morphAt(1.0), flat = morphAt(0.0);
  EXPECT_TRUE(blades.blades);
  EXPECT_EQ(blades.slide, 0.0);
  EXPECT_EQ(blades.strip, 0.0);
  EXPECT_FALSE(strips.blades);
  EXPECT_EQ(strips.slide, 1.0);
  EXPECT_EQ(strips.strip, 1.0);
  EXPECT_FALSE(flat.blades);
  EXPECT_EQ(flat.strip, 0.0);
  Morph before = flat;
  for (double place = 0.0; place <= 2.0; place += 0.01) {
    const Morph now = morphAt(place);
    EXPECT_LE(std::fabs(now.strip - before.strip), 0.016);  // slope 1.5
    EXPECT_LE(std::fabs(now.slide - before.slide), place < 1.0 ? 1.0 : 0.016);
    if (place > 0.0 && place <= 1.0) {
      EXPECT_GE(now.strip, before.strip);
    }
    if (place > 1.0) {
      EXPECT_LE(now.slide, before.slide);
    }
    EXPECT_EQ(now.texture, 1.0);  // S2-13: the ground is always there
    before = now;
  }
}

// S2-12: it takes its time, and turns round wherever it stands.
TEST(TileModelState, MovesAtConstantSpeedAndTurnsRoundAnywhere) {
  TileModelState state;
  setTileModel(state, TileModel::BLADES, TILE_START, 0.5);
  EXPECT_EQ(placeAt(state, TILE_START, 0.5), 0.0);
  EXPECT_NEAR(placeAt(state, TILE_START + fromSeconds(0.25), 0.5), 0.5, 1e-9);
  EXPECT_EQ(placeAt(state, TILE_START + fromSeconds(2.0), 0.5), 2.0);
  setTileModel(state, TileModel::TEXTURE, TILE_START + fromSeconds(0.6), 0.5);
  EXPECT_NEAR(placeAt(state, TILE_START + fromSeconds(0.6), 0.5), 1.2, 1e-6);
  EXPECT_NEAR(placeAt(state, TILE_START + fromSeconds(0.7), 0.5), 1.0, 1e-6);
  EXPECT_EQ(placeAt(state, TILE_START + fromSeconds(9.0), 0.5), 0.0);
  EXPECT_NEAR(placeAt(state, TILE_START, 0.5), 1.2, 1e-6);  // before the change: where it began
  TileModelState hard;
  setTileModel(hard, TileModel::STRIPS, TILE_START, 0.0);
  EXPECT_EQ(placeAt(hard, TILE_START + 1, 0.0), 1.0);
}

// S2-W3: from above layers replace strips, without a jump; fewer far away.
TEST(Layers, ReplaceStripsSeenFromAbove) {
  EXPECT_EQ(layerWeight(0.1), 0.0);
  EXPECT_EQ(layerWeight(1.5), 1.0);
  double before = 0.0;
  for (double elevation = 0.0; elevation < 1.57; elevation += 0.01) {
    const double weight = layerWeight(elevation);
    EXPECT_GE(weight, before);
    EXPECT_LE(weight - before, 0.04);
    before = weight;
  }
  int count = MOST_LAYERS;
  for (double distance = 1.0; distance < 1000.0; distance *= 1.2) {
    EXPECT_LE(layerCount(0.3, scaleAt(distance), TOLERANCE), count);
    count = layerCount(0.3, scaleAt(distance), TOLERANCE);
  }
  EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace vegetation_sim::grass
