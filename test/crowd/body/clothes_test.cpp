// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "crowd/body/clothes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "crowd/body/body_skeleton.h"

namespace vegetation_sim::crowd {
namespace {

constexpr std::uint32_t DRESSED = 400;

double saturationOf(const Vec3& colour) {
  return 1.0 - colour.minCoeff() / std::max(1e-6, colour.maxCoeff());
}

// A group of forty has hardly two people who look alike.
TEST(Clothes, PeopleDiffer) {
  std::set<std::tuple<int, int, int, int, bool, double, double>> looks;
  for (std::uint32_t id = 0; id < 40; ++id) {
    const Clothes c = clothesOf(id);
    looks.insert({static_cast<int>(c.cut), static_cast<int>(c.outfit), static_cast<int>(c.pattern),
                  static_cast<int>(c.neckline), c.long_sleeves, c.shirt.x(), c.hair.x()});
  }
  EXPECT_GE(looks.size(), 38u);
}

TEST(Clothes, EveryCutOutfitAndPatternIsWorn) {
  std::map<HairCut, int> cuts;
  std::map<Outfit, int> outfits;
  std::map<Pattern, int> patterns;
  std::map<Neckline, int> necklines;
  for (std::uint32_t id = 0; id < DRESSED; ++id) {
    const Clothes c = clothesOf(id);
    ++cuts[c.cut];
    ++outfits[c.outfit];
    ++patterns[c.pattern];
    ++necklines[c.neckline];
  }
  EXPECT_EQ(cuts.size(), static_cast<std::size_t>(HairCut::COUNT));
  EXPECT_EQ(outfits.size(), static_cast<std::size_t>(Outfit::COUNT));
  EXPECT_EQ(patterns.size(), 4u);
  EXPECT_EQ(necklines.size(), 3u);
  for (const auto& [cut, count] : cuts) EXPECT_GT(count, 10) << static_cast<int>(cut);
  for (const auto& [outfit, count] : outfits) EXPECT_GT(count, 20) << static_cast<int>(outfit);
}

// Most clothes have muted colours, as those of people outdoors; some are bright.
TEST(Clothes, AreMuted) {
  int bright = 0;
  double sum = 0.0;
  for (std::uint32_t id = 0; id < DRESSED; ++id) {
    const double saturation = saturationOf(clothesOf(id).shirt);
    sum += saturation;
    if (saturation > 0.62) ++bright;
  }
  EXPECT_LT(sum / DRESSED, 0.45);
  EXPECT_GT(bright, 10);
  EXPECT_LT(bright, static_cast<int>(DRESSED) / 4);
}

// Limbs of sensors and markers have the colours of the same clothes.
TEST(Clothes, ShanksAreBareBelowShortsAndSkirts) {
  Clothes clothes = clothesOf(1);
  clothes.skin = Vec3::UnitX();
  clothes.trousers = Vec3::UnitY();
  const auto shank = static_cast<std::size_t>(Part::SHANK);
  for (const Outfit outfit : {Outfit::TROUSERS, Outfit::SHORTS, Outfit::SKIRT, Outfit::COAT}) {
    clothes.outfit = outfit;
    const bool bare = outfit == Outfit::SHORTS || outfit == Outfit::SKIRT;
    for (const std::size_t side : {0u, 1u})
      EXPECT_EQ(colourOf(clothes, shank + side), bare ? clothes.skin : clothes.trousers);
    EXPECT_EQ(colourOf(clothes, static_cast<std::size_t>(Part::THIGH)), clothes.trousers);
  }
}

}  // namespace
}  // namespace vegetation_sim::crowd
