// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/lod/meadow_lod.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error_text.h"
#include "scenes/grass/grass_fixture.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::grass {
namespace {

constexpr Nanoseconds MEADOW_START = 1700000000 * NANOSECONDS_PER_SECOND;

Nanoseconds after(double seconds) {
  return MEADOW_START + fromSeconds(seconds);
}

Viewpoint eyeAt(double x, double y, double z) {
  Viewpoint eye;
  eye.position = Vec3(x, y, z);
  return eye;
}

class MeadowLodTest : public testing::Test {
 protected:
  static MeadowLod makeMeadow(double most_blades = 1e8) {
    MapInput input;
    input.law.columns = input.law.rows = 201;
    input.density.value = 1000.0;
    MeadowSettings settings;
    settings.most_blades = most_blades;
    return MeadowLod(std::make_shared<FeatureMap>(input), std::make_shared<terrain::HeightMap>(), 7,
                     settings);
  }

  static std::map<std::pair<int, int>, TileView> viewsOf(const MeadowLod& meadow,
                                                         const Viewpoint& eye, Nanoseconds stamp) {
    std::map<std::pair<int, int>, TileView> out;
    for (const TileView& view : meadow.viewOf(eye, stamp)) out[{view.row, view.column}] = view;
    return out;
  }

  MeadowLod meadow_{makeMeadow()};
};

// S2-15: there are blades around the viewer, strips in a ring around them, and only ground beyond.
TEST_F(MeadowLodTest, ShowsBladesNearAndStripsFartherAway) {
  const Viewpoint eye = eyeAt(201.0, 201.0, 1.6);
  meadow_.setViewpoints({eye});
  meadow_.advance(MEADOW_START);
  EXPECT_TRUE(meadow_.viewOf(eye, MEADOW_START).empty());  // all begin as ground
  const auto views = viewsOf(meadow_, eye, after(2.0));
  EXPECT_TRUE(views.at({100, 100}).morph.blades);
  EXPECT_EQ(views.at({100, 100}).morph.slide, 0.0);
  EXPECT_EQ(views.at({100, 100}).segments, LINKS);
  EXPECT_FALSE(views.at({100, 125}).morph.blades);
  EXPECT_EQ(views.at({100, 125}).morph.strip, 1.0);
  EXPECT_EQ(views.count({100, 3}), 1u);  // 194 m
  EXPECT_EQ(views.count({3, 3}), 0u);    // 274 m
  EXPECT_LT(views.at({100, 108}).share, 1.0);
}

// S2-15: rows of textures are skipped; every other tile gets its own choice.
TEST_F(MeadowLodTest, FindsAllTilesThatAreMoreThanATexture) {
  const Viewpoint eye = eyeAt(30.0, 201.0, 1.6);
  meadow_.setViewpoints({eye});
  meadow_.advance(MEADOW_START);
  std::map<std::pair<int, int>, TileModel> chosen;
  for (const TileLevel& level : meadow_.snapshot().levels)
    chosen[{level.row, level.column}] = level.tier.target;
  const double tolerance = MeadowSettings().tolerance;
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column) {
      const Vec3 centre(2.0 * column + 1.0, 2.0 * row + 1.0, 0.0);
      const double nearest = length(eye.position - centre) - std::sqrt(2.0);
      const double scale = pixelsPerMetre(eye, nearest);
      const TileModel own =
          chooseTileModel({1.0 / std::sqrt(1000.0), 0.3}, scale, tolerance, TileModel::TEXTURE);
      const auto found = chosen.find({row, column});
      ASSERT_EQ(found == chosen.end() ? TileModel::TEXTURE : found->second, own)
          << row << ' ' << column;
    }
}

TEST_F(MeadowLodTest, WithoutAnEyeIsAllGround) {
  meadow_.advance(MEADOW_START);
  meadow_.advance(after(5.0));
  EXPECT_TRUE(meadow_.snapshot().levels.empty());
}

TEST_F(MeadowLodTest, WithoutGrassIsAllGround) {
  MapInput input;
  input.density.value = 0.0;
  MeadowLod bare(std::make_shared<FeatureMap>(input), std::make_shared<terrain::HeightMap>(), 7,
                 MeadowSettings());
  bare.setViewpoints({eyeAt(50.0, 50.0, 1.6)});
  bare.advance(MEADOW_START);
  EXPECT_TRUE(bare.snapshot().levels.empty());
}

// S2-05: the blades of a tile are the same before and after a walk that took it out of sight.
TEST_F(MeadowLodTest, ShowsTheSameBladesAfterLeavingAndComingBack) {
  const Viewpoint near = eyeAt(201.0, 201.0, 1.6), far = eyeAt(-60.0, -60.0, 1.6);
  const auto bladesNow = [&](Nanoseconds stamp) {
    NodeWind air(meadow_.map(), meadow_.terrain());
    const auto views = meadow_.viewOf(near, stamp);
    air.update(wind::Instant(), {}, MeadowLod::windowOf(views));
    const TreadMap untrodden(meadow_.map().law(), TreadSettings());
    CrushPatch patch;
    TileMotion motion;
    const TileView view = viewsOf(meadow_, near, stamp).at({100, 100});
    const Tile tile = meadow_.tileAt(view, air, untrodden, stamp, patch, motion);
    return posed(tile, motion, tile.blades);
  };
  meadow_.setViewpoints({near});
  meadow_.advance(MEADOW_START);
  const auto before = bladesNow(after(3.0));
  meadow_.setViewpoints({far});
  meadow_.advance(after(4.0));
  meadow_.advance(after(8.0));
  EXPECT_EQ(viewsOf(meadow_, near, after(8.0)).count({100, 100}), 0u);
  meadow_.setViewpoints({near});
  meadow_.advance(after(9.0));
  const auto again = bladesNow(after(12.0));
  ASSERT_EQ(before.size(), again.size());
  for (std::size_t i = 0; i < before.size(); ++i)
    for (int point = 0; point < POINTS; ++point)
      for (int lane = 0; lane < BLOCK; ++lane)
        ASSERT_EQ(before[i].x[point][lane], again[i].x[point][lane]);
}

// S2-W3: tiles far below a viewer have fewer layers.
TEST_F(MeadowLodTest, HasFewerLayersFarBelow) {
  int before = MOST_LAYERS;
  for (const double height : {6.0, 15.0, 40.0, 90.0}) {
    const Viewpoint eye = eyeAt(201.0, 201.0, height);
    MeadowLod meadow = makeMeadow(6e5);
    meadow.setViewpoints({eye});
    meadow.advance(MEADOW_START);
    meadow.advance(after(5.0));
    const auto views = viewsOf(meadow, eye, after(10.0));
    const auto below = views.find({100, 100});
    ASSERT_NE(below, views.end()) << height;
    const double scale = pixelsPerMetre(eye, height - std::sqrt(2.0));
    EXPECT_NEAR(below->second.layers, layerCount(0.3, scale, MeadowSettings().tolerance), 1);
    EXPECT_LE(below->second.layers, before);
    before = below->second.layers;
  }
  EXPECT_LT(before, 4);
}

// The number of blades stays within its budget for every viewpoint.
TEST_F(MeadowLodTest, KeepsTheBudgetOfBlades) {
  MeadowLod small = makeMeadow(50000.0);
  const Viewpoint eye = eyeAt(201.0, 201.0, 1.6);
  small.setViewpoints({eye});
  for (int k = 0; k < 60; ++k) small.advance(after(0.1 * k));
  double blades = 0.0;
  for (const TileView& view : small.viewOf(eye, after(6.0)))
    if (view.morph.blades) blades += 4000.0 * view.share;
  EXPECT_LT(blades, 75000.0);
  EXPECT_GT(blades, 10000.0);
}

// N7: reports what was chosen and why: with room the tolerance is held, without it tiles are held
// back, and what they are off stays within the coarser tolerance.
TEST_F(MeadowLodTest, ReportsWhatItChoseAndWhy) {
  const Viewpoint eye = eyeAt(201.0, 201.0, 1.6);
  for (const double most : {1e8, 2e4}) {
    MeadowLod meadow = makeMeadow(most);
    meadow.setViewpoints({eye});
    for (int i = 0; i < 100; ++i) meadow.advance(after(0.1 * i));
    const TierAllocation& balance = meadow.balance();
    const bool binds = most < 1e8;
    EXPECT_GT(balance.counts[1], 0u);
    EXPECT_GT(balance.counts[2], 0u);
    EXPECT_EQ(balance.held_back > 0, binds);
    EXPECT_EQ(balance.over > 0, binds);
    EXPECT_EQ(balance.wanted > balance.cost, binds);
    EXPECT_LE(balance.cost, 1.1 * most);
    EXPECT_LE(balance.largest, MeadowSettings().tolerance * meadow.snapshot().coarseness);
  }
}

// N7: no limit cycle. A lawn that is seen from above is off by about the same everywhere; a still
// eye sees it stand still from the first tick on, on its budget, and no tile comes and goes.
TEST_F(MeadowLodTest, StandsStillOnItsBudget) {
  MeadowLod meadow = makeMeadow(2e4);
  meadow.setViewpoints({eyeAt(201.0, 201.0, 15.0)});
  meadow.advance(MEADOW_START);
  const auto before = meadow.snapshot();
  EXPECT_LE(meadow.balance().cost, 2e4);
  EXPECT_GE(meadow.balance().cost, 0.7 * 2e4);
  for (int i = 1; i < 40; ++i) {
    meadow.advance(after(0.1 * i));
    ASSERT_EQ(meadow.snapshot().coarseness, before.coarseness) << i;
    ASSERT_EQ(meadow.snapshot().levels.size(), before.levels.size()) << i;
  }
}

// N7: a moving viewer makes no tile flicker: none changes its model twice a second.
TEST_F(MeadowLodTest, NoTileFlickers) {
  MeadowLod meadow = makeMeadow(2e4);
  std::map<std::pair<int, int>, std::pair<TileModel, int>> seen;
  for (int i = 0; i < 30; ++i) {
    meadow.setViewpoints({eyeAt(201.0 + (i % 2 ? 0.1 : 0.0), 201.0, 1.6)});
    meadow.advance(after(0.1 * i));
    if (i < 10) continue;
    EXPECT_LE(meadow.balance().cost, 2e4);
    for (const TileLevel& level : meadow.snapshot().levels) {
      auto& [tier, changes] =
          seen.emplace(std::pair{level.row, level.column}, std::pair{level.tier.target, 0})
              .first->second;
      changes += tier != level.tier.target;
      tier = level.tier.target;
      EXPECT_LE(changes, 2) << level.row << ' ' << level.column;
    }
  }
}

// N7: what is asked for does not depend on what there is, and all that would be finer is counted.
TEST_F(MeadowLodTest, ReportsAllThatTheBudgetHoldsBack) {
  MeadowLod rich = makeMeadow(), poor = makeMeadow(2e4);
  for (MeadowLod* meadow : {&rich, &poor}) {
    meadow->setViewpoints({eyeAt(201.0, 201.0, 1.6)});
    for (int i = 0; i < 100; ++i) meadow->advance(after(0.1 * i));
  }
  EXPECT_EQ(poor.balance().wanted, rich.balance().wanted);
  std::map<std::pair<int, int>, TileModel> of_poor;
  for (const TileLevel& level : poor.snapshot().levels)
    of_poor[{level.row, level.column}] = level.tier.target;
  std::size_t held_back = 0;
  for (const TileLevel& level : rich.snapshot().levels) {
    const auto found = of_poor.find({level.row, level.column});
    held_back += found == of_poor.end() || found->second < level.tier.target;
  }
  EXPECT_EQ(poor.balance().held_back, held_back);
  EXPECT_GT(poor.balance().over, poor.balance().counts[1]);  // textures too
}

TEST_F(MeadowLodTest, LeavesOutWhatTheEyeDoesNotSee) {
  Viewpoint eye = eyeAt(201.0, 201.0, 1.6);
  eye.cone_cosine = std::cos(0.5);
  meadow_.setViewpoints({eye});
  meadow_.advance(MEADOW_START);
  const auto views = viewsOf(meadow_, eye, after(2.0));
  EXPECT_EQ(views.count({100, 110}), 1u);
  EXPECT_EQ(views.count({100, 90}), 0u);  // behind
}

// S2-W3: views contain the elevation of the viewer.
TEST_F(MeadowLodTest, KnowsFromHowSteepATileIsSeen) {
  const Viewpoint eye = eyeAt(201.0, 201.0, 30.0);
  meadow_.setViewpoints({eye});
  meadow_.advance(MEADOW_START);
  const auto views = viewsOf(meadow_, eye, after(2.0));
  EXPECT_EQ(layerWeight(views.at({100, 100}).elevation), 1.0);
  EXPECT_EQ(layerWeight(views.at({100, 160}).elevation), 0.0);
}

// N6: one structure is all the state; restored, the run goes on to the bit.
TEST_F(MeadowLodTest, GoesOnFromARestoredMemory) {
  const auto step = [](MeadowLod& meadow, int k) {
    const double x = 150.0 + 0.5 * k;
    meadow.setViewpoints({eyeAt(x, 201.0, 1.6)});
    meadow.advance(after(0.1 * k));
  };
  for (int k = 0; k < 20; ++k) step(meadow_, k);
  MeadowLod copy = makeMeadow();
  copy.restore(meadow_.snapshot());
  EXPECT_EQ(copy.snapshot().hash(), meadow_.snapshot().hash());
  for (int k = 20; k < 30; ++k) {
    step(meadow_, k);
    step(copy, k);
    ASSERT_EQ(copy.snapshot().hash(), meadow_.snapshot().hash()) << k;
  }
  const std::uint64_t before = meadow_.snapshot().hash();
  step(meadow_, 31);
  EXPECT_NE(meadow_.snapshot().hash(), before);
}

TEST_F(MeadowLodTest, StartsAnewWhenTimeGoesBack) {
  const Viewpoint eye = eyeAt(201.0, 201.0, 1.6);
  meadow_.setViewpoints({eye});
  meadow_.advance(after(10.0));
  meadow_.advance(after(20.0));
  meadow_.advance(after(5.0));
  EXPECT_TRUE(meadow_.viewOf(eye, after(5.0)).empty());
  EXPECT_FALSE(meadow_.viewOf(eye, after(6.0)).empty());
}

TEST_F(MeadowLodTest, RejectsBadSettingsWithTheirNames) {
  MeadowSettings settings;
  settings.tolerance = -1.0;
  settings.transition = std::nan("");
  EXPECT_EQ(errorOf([&] {
              MeadowLod meadow(std::make_shared<FeatureMap>(),
                               std::make_shared<terrain::HeightMap>(), 7, settings);
            }),
            "meadow: tolerance = -1 pixel is outside 0.1 to 100 pixel\n"
            "meadow: transition = nan s is not finite, allowed is 0 to 60 s");
}

}  // namespace
}  // namespace vegetation_sim::grass
