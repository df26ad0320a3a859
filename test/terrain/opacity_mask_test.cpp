// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "terrain/opacity_mask.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error_text.h"
#include "terrain/png_fixture.h"

namespace vegetation_sim::terrain {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string refusalOfMask(const std::string& bytes) {
  return errorOf([&] { parseOpacityMask(bytes); });
}

/// Returns the bytes of a picture of grey and alpha in one row.
std::string rowOf(const Bytes& alphas) {
  Bytes samples;
  for (const std::uint8_t alpha : alphas) samples.insert(samples.end(), {200, alpha});
  return pngOf(samples, static_cast<int>(alphas.size()), PNG_FORMAT_GA);
}

// S3-29: displays draw a pixel whose alpha is at least 128 of 255.
TEST(OpacityMask, PixelsAreOpaqueFromHalfAlphaOn) {
  const OpacityMask mask = parseOpacityMask(rowOf({0, 127, 128, 255}));
  EXPECT_EQ(mask.columns, 4);
  EXPECT_EQ(mask.rows, 1);
  EXPECT_EQ(mask.opaque, (std::vector<bool>{false, false, true, true}));
  const OpacityMask deep = parseOpacityMask(
      pngOf(std::vector<std::uint16_t>{0, 0x7fff, 0, 0x8000}, 2, PNG_FORMAT_LINEAR_Y_ALPHA));
  EXPECT_EQ(deep.opaque, (std::vector<bool>{false, true}));
}

TEST(OpacityMask, PlacesCountFromTheLowerLeftCorner) {
  // clang-format off
  const Bytes samples{1, 2, 3, 255, 1, 2, 3, 0,
                      1, 2, 3, 0,   1, 2, 3, 0};
  // clang-format on
  const OpacityMask mask = parseOpacityMask(pngOf(samples, 2, PNG_FORMAT_RGBA));
  EXPECT_TRUE(mask.isOpaqueAt(0.2, 0.8));
  EXPECT_FALSE(mask.isOpaqueAt(0.2, 0.2));
  EXPECT_FALSE(mask.isOpaqueAt(0.8, 0.8));
  EXPECT_TRUE(mask.isOpaqueAt(-3.0, 7.0));  // as on the edge
  EXPECT_FALSE(mask.isOpaqueAt(1.0, 1.0));
  EXPECT_FALSE(mask.isOpaqueAt(std::numeric_limits<double>::quiet_NaN(), 0.0));
}

TEST(OpacityMask, IsEmptyWithoutAlpha) {
  const OpacityMask mask = parseOpacityMask(pngOf(Bytes{1, 2, 3}, 1, PNG_FORMAT_RGB));
  EXPECT_TRUE(mask.empty());
  EXPECT_TRUE(mask.isOpaqueAt(0.5, 0.5));
}

TEST(OpacityMask, FaultyFilesAreRefused) {
  EXPECT_EQ(refusalOfMask(""), "is no PNG");
  EXPECT_EQ(refusalOfMask("root:x:0:0:root"), "is no PNG");
  const std::string good = rowOf({0, 255, 0});
  for (std::size_t length = 8; length < good.size(); ++length)
    EXPECT_EQ(refusalOfMask(good.substr(0, length)), "is damaged") << length;
  const auto side = static_cast<std::size_t>(LONGEST_MASK_SIDE);
  EXPECT_EQ(refusalOfMask(rowOf(Bytes(side, 0))), "");
  EXPECT_EQ(refusalOfMask(rowOf(Bytes(side + 1, 0))),
            "has 4097 x 1 pixels, allowed are 4096 x 4096");
}

}  // namespace
}  // namespace vegetation_sim::terrain
