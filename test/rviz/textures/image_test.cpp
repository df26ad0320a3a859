// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/textures/image.h"

#include <gtest/gtest.h>

#include "rviz/textures/bark_texture.h"
#include "rviz/textures/grain_texture.h"
#include "rviz/textures/leaf_atlas.h"
#include "rviz/textures/sky_texture.h"
#include "tree/mesh/bark_mesh.h"

namespace vegetation_sim::view {
namespace {

using forest::LeafShape;

float brightness(const Rgba& colour) {
  return (colour[0] + colour[1] + colour[2]) / 3.f;
}

TEST(Image, BlendsByAlpha) {
  Image picture(2, 1, {0.f, 0.f, 0.f, 1.f});
  picture.blend(0, 0, {1.f, 1.f, 1.f, 0.25f});
  picture.blend(5, -3, {1.f, 1.f, 1.f, 1.f});  // A pixel outside of the image has no effect.
  EXPECT_FLOAT_EQ(picture.at(0, 0)[0], 0.25f);
  EXPECT_FLOAT_EQ(picture.at(1, 0)[0], 0.f);
  EXPECT_EQ(picture.bytes(), (std::vector<std::uint8_t>{64, 64, 64, 255, 0, 0, 0, 255}));
}

TEST(Image, MipmapsHalveDownToOnePixelAndKeepTheMean) {
  Image picture(8, 4, {});
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i][0] = i % 2 ? 1.f : 0.f;
  const std::vector<Image> levels = mipmaps(picture);
  EXPECT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels.back().rows, 1);
  for (const Rgba& pixel : levels.back().pixels) EXPECT_FLOAT_EQ(pixel[0], 0.5f);
}

TEST(Noise, IsBoundedSmoothAndRepeats) {
  const Noise noise(7);
  for (float x = -100.f; x < 100.f; x += 0.37f) {
    const float y = 0.61f * x;
    EXPECT_GE(noise.fractal(x, y, 4), 0.f);
    EXPECT_LE(noise.fractal(x, y, 4), 1.f);
    // The largest slope of the fade is 1.5 per unit.
    EXPECT_NEAR(noise.smooth(x, y), noise.smooth(x + 0.01f, y), 0.0151f);
    EXPECT_NEAR(noise.smooth(x, y), noise.smooth(x + Noise::PERIOD, y), 1e-4f);
  }
}

TEST(LeafPicture, ShapesAreCardsWithHolesAndDifferFromEachOther) {
  for (const bool bough : {false, true}) {
    for (int a = 0; a < 4; ++a) {
      const Image picture = leafPicture(static_cast<LeafShape>(a), bough, 64);
      EXPECT_GT(coverage(picture), 0.15) << a;
      EXPECT_LT(coverage(picture), 0.8) << a;
      for (int b = 0; b < a; ++b)
        EXPECT_NE(picture.bytes(), leafPicture(static_cast<LeafShape>(b), bough, 64).bytes());
    }
  }
}

TEST(LeafAtlas, MipmapsKeepTheCoverage) {
  const std::vector<Image> levels = leafAtlas(128);
  ASSERT_EQ(levels.size(), 6u);
  for (const Image& level : levels) {
    EXPECT_EQ(level.columns, 2 * level.rows);
    // One pixel of 32 x 16 is 0.2 %, and ties in alpha may add a few pixels.
    EXPECT_NEAR(coverage(level), coverage(levels.front()), 0.04) << level.columns;
  }
}

/// Share of a card's square that is drawn, and share of its leaves that is drawn.
struct Cut {
  double drawn{0.0}, held{0.0};
};

Cut cutOf(const Image& atlas, int cell) {
  constexpr int SAMPLES = 256;  // samples along the square
  const forest::LeafOutline& outline =
      forest::leafOutline(static_cast<LeafShape>(cell % 4), cell >= 4);
  const auto holds = [&](float x, float y) {
    bool inside = true;
    for (std::size_t i = 0; i < forest::LEAF_CORNERS; ++i) {
      const auto &a = outline[i], &b = outline[(i + 1) % forest::LEAF_CORNERS];
      inside = inside && (b[0] - a[0]) * (y - a[1]) >= (b[1] - a[1]) * (x - a[0]);
    }
    return inside;
  };
  const int side = atlas.columns / 4;
  double leaves = 0.0;
  Cut out;
  for (int r = 0; r < SAMPLES; ++r) {
    for (int c = 0; c < SAMPLES; ++c) {
      const Rgba& pixel =
          atlas.at(side * (cell % 4) + c * side / SAMPLES, side * (cell / 4) + r * side / SAMPLES);
      const bool in = holds((static_cast<float>(c) + 0.5f) / SAMPLES,
                            1.f - (static_cast<float>(r) + 0.5f) / SAMPLES);
      out.drawn += in ? 1.0 / (SAMPLES * SAMPLES) : 0.0;
      leaves += pixel[3] >= ALPHA_LIMIT ? 1.0 : 0.0;
      out.held += in && pixel[3] >= ALPHA_LIMIT ? 1.0 : 0.0;
    }
  }
  out.held /= leaves;
  return out;
}

// A card is drawn as its outline, which contains nearly all of its leaves and is smaller than the
// square. In the smallest images, of 4 x 4 and 2 x 2 pixels, the pixels at the border have a large
// share.
TEST(LeafAtlas, OutlinesHoldThePictures) {
  const std::vector<Image> levels = leafAtlas(128);
  ASSERT_EQ(levels.size(), 6u);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    for (int cell = 0; cell < 8; ++cell) {
      const Cut cut = cutOf(levels[level], cell);
      EXPECT_GT(cut.held, level < 4 ? 0.98 : (level == 4 ? 0.95 : 0.84)) << level << " " << cell;
      EXPECT_LT(cut.drawn, 0.9) << cell;
    }
  }
}

TEST(LeafAtlas, EachShapeHasItsCell) {
  for (int shape = 0; shape < 4; ++shape) {
    for (const bool bough : {false, true}) {
      const auto leaf = static_cast<LeafShape>(shape);
      const auto place = leafAtlasPlace(leaf, bough, {0.5f, 0.5f});
      EXPECT_FLOAT_EQ(place[0], 0.125f + 0.25f * static_cast<float>(shape));
      EXPECT_FLOAT_EQ(place[1], bough ? 0.75f : 0.25f);
      EXPECT_FLOAT_EQ(leafAtlasPlace(leaf, bough, {0.5f, 0.f})[1], bough ? 1.f : 0.5f);
    }
  }
}

TEST(BarkPicture, BirchIsPaleWithDarkLenticels) {
  const Image birch = barkPicture(LeafShape::SMALL, 64);
  int pale = 0, dark = 0;
  for (const Rgba& pixel : birch.pixels) {
    pale += pixel[0] > 0.8f ? 1 : 0;
    dark += pixel[0] < 0.5f ? 1 : 0;
  }
  EXPECT_GT(pale, 10 * 64 * 64 / 4);
  EXPECT_GT(dark, 64 * 4 * 64 / 100);
}

TEST(BarkPicture, ClosesAroundTheTrunk) {
  for (const LeafShape shape : {LeafShape::BROAD, LeafShape::NEEDLE, LeafShape::LONG}) {
    const Image picture = barkPicture(shape, 128);
    double step = 0.0;
    for (int r = 0; r < picture.rows; ++r)
      step +=
          std::abs(static_cast<double>(picture.at(0, r)[0] - picture.at(127, r)[0])) / picture.rows;
    EXPECT_LT(step, 0.15);  // The step is as between any two neighbouring columns.
  }
}

// The upper edge continues the lower edge without mirroring in the renderer.
TEST(BarkAtlas, RepeatsAlongTheWood) {
  const Image atlas = barkAtlas(64);
  ASSERT_EQ(atlas.rows, 128);
  const auto stepTo = [&](int row, int next) {
    double sum = 0.0;
    for (int c = 0; c < atlas.columns; ++c)
      sum += std::abs(static_cast<double>(atlas.at(c, row)[0] - atlas.at(c, next)[0]));
    return sum / atlas.columns;
  };
  EXPECT_EQ(stepTo(127, 0), 0.0);
  EXPECT_EQ(stepTo(63, 64), 0.0);
  EXPECT_GT(stepTo(0, 32), 0.02);  // The image differs along the column.
}

/// Returns the mean lightness of a square of pixels, with periodic borders.
double meanOf(const Image& picture, int column, int row, int edge) {
  double sum = 0.0;
  for (int r = row; r < row + edge; ++r)
    for (int c = column; c < column + edge; ++c)
      sum += static_cast<double>(picture.at((c + picture.columns) % picture.columns,
                                            (r + picture.rows) % picture.rows)[0]);
  return sum / (edge * edge);
}

// The grain changes across the border no more than elsewhere, in both directions.
TEST(GrainPicture, RepeatsWithoutASeam) {
  constexpr int EDGE = 256, BLOCK = 8;
  const Image grain = grainPicture(EDGE);
  const auto stepAt = [&](int at, bool down) {
    double sum = 0.0;
    for (int i = 0; i < EDGE; i += BLOCK) {
      const double before =
          down ? meanOf(grain, i, at - BLOCK, BLOCK) : meanOf(grain, at - BLOCK, i, BLOCK);
      sum += std::abs(before - (down ? meanOf(grain, i, at, BLOCK) : meanOf(grain, at, i, BLOCK)));
    }
    return sum * BLOCK / EDGE;
  };
  for (const bool down : {false, true}) {
    double inside = 0.0;
    for (int at = BLOCK; at < EDGE; at += BLOCK)
      inside += stepAt(at, down) * BLOCK / (EDGE - BLOCK);
    EXPECT_LT(stepAt(0, down), 1.2 * inside);
  }
}

TEST(SkyPicture, IsHazyBelowBlueAboveAndBrightAroundTheSun) {
  const Daylight light = daylightOf(1.5707963, 0.7);
  const Image sky = skyPicture(light, SkyShapes(128, 64));
  double zenith = 0.0, horizon = 0.0;
  for (int c = 0; c < sky.columns; ++c) {
    zenith += static_cast<double>(sky.at(c, 0)[2] - sky.at(c, 0)[0]) / sky.columns;
    horizon += static_cast<double>(sky.at(c, 60)[2] - sky.at(c, 60)[0]) / sky.columns;
  }
  EXPECT_GT(zenith, 0.2);
  EXPECT_LT(horizon, 0.5 * zenith);
  int row = 0;  // row of the sun
  while (skyElevation((row + 0.5) / sky.rows) > 0.7) ++row;
  EXPECT_GT(brightness(sky.at(32, row)), brightness(sky.at(96, row)));
}

TEST(Daylight, TheSunStandsWhereItIsSetAndReddensWhenLow) {
  const Daylight noon = daylightOf(0.0, 1.2), evening = daylightOf(0.0, 0.15);
  EXPECT_NEAR(length(noon.to_sun), 1.0, 1e-12);
  EXPECT_GT(noon.to_sun.x(), 0.0);
  EXPECT_GT(noon.to_sun.z(), evening.to_sun.z());
  EXPECT_GT(evening.sun[0] / evening.sun[2], noon.sun[0] / noon.sun[2]);
}

}  // namespace
}  // namespace vegetation_sim::view
