// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/meadow_texture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegetation_sim::view {
namespace {

/// Returns a map that is dense in the east and bare in the west.
grass::FeatureMap halfBare() {
  grass::MapInput input;
  input.law.columns = input.law.rows = 11;
  input.density = {0.0, {11, 11, 1, {}}, 0.0, 800.0};
  for (int i = 0; i < 11 * 11; ++i) input.density.image.samples.push_back(i % 11 > 5 ? 1 : 0);
  return grass::FeatureMap(input);
}

float lightness(const Rgba& c) {
  return (c[0] + c[1] + c[2]) / 3.f;
}

// S2-13: the ground has the colours of the map, soil where nothing grows and grass where it is
// dense, and it is darker under grass.
TEST(MeadowPainter, PaintsSoilAndGrass) {
  const grass::FeatureMap map = halfBare();
  const terrain::HeightMap flat;
  const Daylight light;
  const MeadowPainter painter(map, flat, light, {1.f, 1.f, 1.f, 1.f});
  const Image picture = painter.whole();
  ASSERT_EQ(picture.columns, 10 * painter.pixelsPerTile());
  const int middle = picture.rows / 2;
  const Rgba soil = picture.at(picture.columns * 3 / 10, middle);
  const Rgba grass = picture.at(picture.columns * 75 / 100, middle);
  EXPECT_GT(soil[0], soil[1]);
  EXPECT_GT(grass[1], grass[0]);
  EXPECT_EQ(soil[3], 1.f);
  EXPECT_LT(grass[3], 0.7f);
}

// S2-21: a track is visible in the texture, and a tile that is painted alone equals the tile of the
// whole texture.
TEST(MeadowPainter, PaintsTracksInTiles) {
  const grass::FeatureMap map = halfBare();
  const terrain::HeightMap flat;
  const Daylight light;
  const MeadowPainter painter(map, flat, light, {1.f, 1.f, 1.f, 1.f});
  const Image whole = painter.whole(), plain = painter.tile(8, 4, nullptr);
  for (int r = 0; r < plain.rows; ++r)
    for (int c = 0; c < plain.columns; ++c)
      for (std::size_t k = 0; k < 4; ++k)
        ASSERT_NEAR(plain.at(c, r)[k], whole.at(painter.left(8) + c, painter.top(4) + r)[k], 1e-5);
  grass::CrushPatch patch;
  patch.cells = 4;
  patch.tilt.assign(25, 0.f);
  patch.tx.assign(25, 0.f);
  patch.ty.assign(25, 0.f);
  // The direction is from west to east.
  for (std::size_t i = 10; i < 15; ++i) patch.tilt[i] = patch.tx[i] = 1.5f;
  const Image trodden = painter.tile(8, 4, &patch);
  const int row = trodden.rows / 2, column = trodden.columns / 2;
  EXPECT_GT(std::fabs(lightness(trodden.at(column, row)) / lightness(plain.at(column, row)) - 1.f),
            0.1f);
  EXPECT_GT(trodden.at(column, row)[3], plain.at(column, row)[3]);
  EXPECT_EQ(trodden.at(column, 0), plain.at(column, 0));
}

TEST(MeadowPainter, RejectsMapsThatAreTooLarge) {
  EXPECT_FALSE(isBare(halfBare()));
  EXPECT_TRUE(isPaintable(halfBare()));
  grass::MapInput input;
  input.law.rows = 2;
  input.law.columns = 2049;
  input.density.value = 0.0;
  EXPECT_TRUE(isBare(grass::FeatureMap(input)));
  EXPECT_TRUE(isPaintable(grass::FeatureMap(input)));
  ++input.law.columns;
  EXPECT_FALSE(isPaintable(grass::FeatureMap(input)));
}

// S2-10, S2-11: smaller mipmaps of the strips show the same share for each density.
TEST(StripPictures, KeepTheirSharesWithDistance) {
  const std::vector<Image> pictures = stripPictures(256, 64, 60);
  ASSERT_EQ(pictures.back().columns, 1);
  const auto share = [](const Image& picture, float density) {
    double shown = 0.0;
    for (const Rgba& pixel : picture.pixels) shown += pixel[3] > 1.f - density ? 1.0 : 0.0;
    return shown / static_cast<double>(picture.pixels.size());
  };
  for (const float density : {0.2f, 0.5f, 1.f})
    for (std::size_t level = 1; level < 5; ++level)
      EXPECT_NEAR(share(pictures[level], density), share(pictures[0], density), 0.03)
          << level << " " << density;
}

// The first row has the roots, where the v coordinate is 0.
TEST(StripPictures, StandOnTheirRoots) {
  const Image picture = stripPictures(256, 64, 60).front();
  int first = 0, last = 0;
  for (int c = 0; c < picture.columns; ++c) {
    first += picture.at(c, 0)[3] > 0.f;
    last += picture.at(c, picture.rows - 1)[3] > 0.f;
  }
  EXPECT_GT(first, 50);
  EXPECT_EQ(last, 0);
}

// S2-W3: the number of dots follows the density.
TEST(LayerPictures, ShowMoreDotsWhereItIsDenser) {
  const Image picture = layerPictures(64).front();
  int few = 0, many = 0;
  for (const Rgba& pixel : picture.pixels) {
    few += pixel[3] > 0.8f;
    many += pixel[3] > 0.2f;
  }
  EXPECT_GT(few, 40);
  EXPECT_GT(many, 2 * few);
}

}  // namespace
}  // namespace vegetation_sim::view
