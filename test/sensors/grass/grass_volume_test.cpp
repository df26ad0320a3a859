// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/grass/grass_volume.h"

#include <gtest/gtest.h>

#include "scenes/sensors/lidar_scene.h"

namespace vegetation_sim::scan {
namespace {

// What rays over a piece of lawn meet within 1.5 m.
struct Met {
  double share{0.0};   ///< of the rays that meet a blade
  double height{0.0};  ///< of the meetings, mean [m]
};

template <class Grass>
Met meetings(const Grass& grass, double low, double high, int rays = 4000) {
  const Random random(8);
  Met out;
  for (int i = 0; i < rays; ++i) {
    const auto k = static_cast<std::uint64_t>(i);
    const Vec3 from(random.uniform(10 * k, 9.2, 10.8), random.uniform(10 * k + 1, 9.7, 10.3),
                    random.uniform(10 * k + 2, low, high));
    const Ray ray(from, randomDirection(random, k + 100000, -0.3, 0.2));
    Hit nearest;
    nearest.distance = 1.5;
    if (ray.direction.z() < 0.0) nearest.distance = std::min(1.5, -from.z() / ray.direction.z());
    grass.meet(ray, nearest);
    if (nearest.label != Label::GRASS) continue;
    out.share += 1.0 / rays;
    out.height += ray.at(nearest.distance).z();
  }
  out.height /= std::max(1.0, out.share * rays);
  return out;
}

void cutAll(Lawn& lawn, double height) {
  grass::CutArea area;
  area.outline = {{10.0, 10.0}};
  area.radius = 20.0;
  area.height = height;
  lawn.tread.cuts().cut(*lawn.layout.map, area);
}

struct Case {
  const char* name;
  double height, density;
  Vec3 air;
  bool trodden, cut{false};
};

// N1: the medium against every blade. 4000 rays: a share is sure to 0.016, twice its deviation.
TEST(GrassVolume, LetsThroughAsMuchAsItsBladesDo) {
  for (const Case& one :
       {Case{"lawn", 0.3, 400.0, Vec3::Zero(), false}, Case{"thin", 0.3, 60.0, Vec3::Zero(), false},
        Case{"wind", 0.3, 100.0, Vec3(7, 0, 0), false},
        Case{"trodden", 0.3, 400.0, Vec3::Zero(), true},
        Case{"cut", 0.3, 1600.0, Vec3::Zero(), false, true}}) {
    Lawn lawn(one.height, one.density);
    if (one.trodden) lawn.treadLane();
    if (one.cut) cutAll(lawn, 0.12);
    const wind::Field wind = breezeOf(one.air);
    GrassVolume grass_volume;
    lawn.show(grass_volume, wind);
    const Blades blades(lawn, wind, START + fromSeconds(60.0), 3, 6);
    const Met medium = meetings(grass_volume, 0.02, 0.25), each = meetings(blades, 0.02, 0.25);
    RecordProperty(std::string(one.name) + "_share_medium", std::to_string(medium.share));
    RecordProperty(std::string(one.name) + "_share_blades", std::to_string(each.share));
    RecordProperty(std::string(one.name) + "_height_medium", std::to_string(medium.height));
    RecordProperty(std::string(one.name) + "_height_blades", std::to_string(each.height));
    EXPECT_NEAR(medium.share, each.share, 0.05) << one.name;
    EXPECT_NEAR(medium.height, each.height, 0.006) << one.name;
    EXPECT_GT(medium.share, 0.05) << one.name;
  }
}

// The columns of grass as an object that meetings() can ask.
struct Columns {
  const GrassVolume& grass;
  void meet(const Ray& ray, Hit& nearest) const { grass.meetBlades(ray, nearest); }
};

// Returns the share of steep rays that meet a blade.
template <class Grass>
double steepShare(const Grass& grass) {
  int out = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Vec3 from(6.0 + 0.05 * double(i % 100), 8.0 + 0.05 * double(i / 100), 1.0);
    const Ray ray(from, randomDirection(Random(3), i, -1.5, -1.2));
    Hit nearest;
    nearest.distance = -from.z() / ray.direction.z();
    grass.meet(ray, nearest);
    out += nearest.label == Label::GRASS;
  }
  return out / 4000.0;
}

// The same rays meet columns as often as cubes, and as high; so do steep ones. Means over lawns of
// other random numbers, since rays over a small piece of one lawn meet the same cubes.
TEST(GrassVolume, ColumnsLetThroughAsMuchAsCubesDo) {
  constexpr int LAWNS = 40;
  for (const double density : {60.0, 400.0}) {
    double share = 0.0, height = 0.0, steep = 0.0, of_cubes = 0.0;
    for (int i = 0; i < LAWNS; ++i) {
      Lawn lawn(0.3, density);
      lawn.layout.seed = Random(5).bits(static_cast<std::uint64_t>(i));
      GrassVolume grass;
      lawn.show(grass, breezeOf(Vec3(3, 0, 0)));
      const Met cubes = meetings(grass, 0.02, 0.25), columns = meetings(Columns{grass}, 0.02, 0.25);
      share += (columns.share - cubes.share) / LAWNS;
      height += (columns.height - cubes.height) / LAWNS;
      of_cubes += steepShare(grass) / LAWNS;
      steep += steepShare(Columns{grass}) / LAWNS;
    }
    EXPECT_NEAR(share, 0.0, 0.006) << density;
    EXPECT_NEAR(height, 0.0, 0.0015) << density;
    EXPECT_NEAR(steep, of_cubes, 0.006) << density;
    EXPECT_GT(steep, 0.01) << density;
  }
}

TEST(GrassVolume, EndsAtTheStubbleOfCutGrass) {
  Lawn lawn(0.3, 400.0);
  cutAll(lawn, 0.08);
  GrassVolume grass;
  lawn.show(grass);
  const Vec3 level(1.0, 0.0, 0.0);
  EXPECT_EQ(grass.extinction({10.0, 10.0, 0.081}, level), 0.0);
  EXPECT_GT(grass.extinction({10.0, 10.0, 0.06}, level), 0.0);
  EXPECT_EQ(grass.depthAbove({10.0, 10.0, 0.081}, Vec3(0.0, 0.0, 1.0)), 0.0);
  EXPECT_GT(grass.depthAbove({10.0, 10.0, 0.0}, Vec3(0.0, 0.0, 1.0)), 0.0);
}

// N1
TEST(GrassVolume, ThatIsTroddenReturnsLower) {
  Lawn upright, trodden;
  trodden.treadLane();
  GrassVolume before, after;
  upright.show(before);
  trodden.show(after);
  const auto top = [](const GrassVolume& grass_volume) {  // rays of a robot, forward
    double sum = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 from(5.0 + 0.005 * i, 10.3, 1.0);
      const Ray ray(from, Vec3(1.0, 0.0, -0.2).normalized());
      Hit nearest;
      nearest.distance = -from.z() / ray.direction.z();
      grass_volume.meet(ray, nearest);
      sum += ray.at(nearest.distance).z();
    }
    return sum / 1000.0;
  };
  EXPECT_GT(top(before), 0.06);  // [m], of 0.3
  EXPECT_LT(top(after), 0.35 * top(before));
}

TEST(GrassVolume, BentByWindIsLower) {
  const Lawn lawn;
  GrassVolume still, windy;
  lawn.show(still);
  lawn.show(windy, breezeOf(Vec3(12, 0, 0)));
  EXPECT_LT(meetings(windy, 0.1, 0.3).height, meetings(still, 0.1, 0.3).height - 0.005);
}

// A static scene gives the same returns in every scan.
TEST(GrassVolume, InStillAirLooksTheSameAtAnyTime) {
  const Lawn lawn;
  GrassVolume now, later;
  lawn.show(now, wind::Field(), 1.0);
  lawn.show(later, wind::Field(), 2.0);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const Ray ray(Vec3(10, 10, 0.8), randomDirection(Random(2), i, -0.6, -0.05));
    Hit a, b;
    a.distance = b.distance = 20.0;
    now.meet(ray, a);
    later.meet(ray, b);
    EXPECT_TRUE(same(a, b));
  }
}

/// A hilly meadow of three species whose height, density and mix vary with the place.
Lawn hillyMeadow(terrain::HeightMap& hills) {
  grass::MapInput input;
  input.law.columns = input.law.rows = 11;
  const auto varied = [](std::uint32_t seed) {
    terrain::GreyImage image;
    image.columns = image.rows = 11;
    image.white = 255;
    for (std::uint32_t i = 0; i < 121; ++i)
      image.samples.push_back(static_cast<std::uint16_t>(mix32(i + 1000 * seed) % 256));
    return image;
  };
  input.height = {0.0, varied(1), 0.0, 0.6};
  input.density = {0.0, varied(2), 0.0, 300.0};
  input.shape = {0.0, varied(3), 0.0, 1.0};
  for (std::uint32_t k = 0; k < 3; ++k) {
    grass::SpeciesInput species;
    species.species.name = std::to_string(k);
    species.species.height = 0.5 + 0.5 * k;
    species.species.height_spread = 0.4 * k;
    species.species.width = 0.004 + 0.004 * k;
    species.mix = {0.0, varied(4 + k), 0.0, 1.0};
    input.species.push_back(species);
  }
  terrain::HeightMapLaw law;
  law.resolution = 2.0;
  law.height_max = 1.5;
  hills = terrain::HeightMap(law, varied(9));
  Lawn out;
  out.layout.map = std::make_shared<const grass::FeatureMap>(input);
  return out;
}

// N1
TEST(GrassVolume, HasTheHitsOfAnEvaluationOfEveryCell) {
  terrain::HeightMap hills;
  Lawn meadow = hillyMeadow(hills);
  const auto ground = std::make_shared<const terrain::HeightMap>(hills);
  for (const bool trodden : {false, true}) {
    if (trodden) meadow.treadLane();
    for (const double wind : {0.0, 3.0, 14.0}) {
      GrassVolume grass_volume;
      grass_volume.update(meadow.layout, meadow.tread, ground,
                          wind > 0.0 ? breezeOf(Vec3(wind, 1, 0)) : wind::Field(),
                          Vec3(10.0, 10.0, 1.0), wind > 5.0 ? 30.0 : 6.0,
                          START + fromSeconds(60.0));
      int hits = 0, columns = 0;
      const Random random(9);
      for (std::uint64_t i = 0; i < 3000; ++i) {
        const Ray ray(Vec3(random.uniform(3 * i, -1.0, 21.0), random.uniform(3 * i + 1, -1.0, 21.0),
                           random.uniform(3 * i + 2, 0.5, 2.5)),
                      randomDirection(random, i + 90000, -0.6, 0.1));
        Hit likely, each;
        likely.distance = each.distance = 40.0;
        grass_volume.meet(ray, likely);
        grass_volume.meet(ray, each, GrassVolume::Cells::ALL);
        EXPECT_TRUE(same(likely, each)) << trodden << " " << wind << " " << i;
        hits += each.label == Label::GRASS;
        // Borders of columns are rounded in another way where a ray enters them anew.
        likely = each = Hit();
        likely.distance = each.distance = 40.0;
        grass_volume.meetBlades(ray, likely);
        grass_volume.meetBlades(ray, each, GrassVolume::Cells::ALL);
        EXPECT_NEAR(likely.distance, each.distance, 1e-9) << trodden << " " << wind << " " << i;
        columns += each.label == Label::GRASS;
      }
      EXPECT_GT(hits, 500) << trodden << " " << wind;
      EXPECT_GT(columns, 500) << trodden << " " << wind;
    }
  }
}

// The bounds hold wherever the extinction is not 0, at the middles of the columns in which it is
// evaluated.
TEST(GrassVolume, IsNowhereDenserThanItsBounds) {
  terrain::HeightMap hills;
  Lawn meadow = hillyMeadow(hills);
  for (const bool trodden : {false, true}) {
    if (trodden) meadow.treadLane();
    GrassVolume grass_volume;
    grass_volume.update(meadow.layout, meadow.tread,
                        std::make_shared<const terrain::HeightMap>(hills), breezeOf(Vec3(9, 1, 0)),
                        Vec3(10.0, 10.0, 1.0), 30.0, START + fromSeconds(60.0));
    const Random random(4);
    int dense = 0, flat = 0;
    double nearest = 0.0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
      const auto middle = [&](std::uint64_t k) {
        return GRASS_CELL * (std::floor(random.uniform(k, 0.0, 400.0)) + 0.5);
      };
      const double x = middle(3 * i), y = middle(3 * i + 1);
      const double height = random.uniform(3 * i + 2, 0.0, 0.6);
      const double here = grass_volume.extinction(Vec3(x, y, hills.height(x, y) + height),
                                                  randomDirection(random, i + 90000, -1.5, 1.5));
      const double bound = grass_volume.bounds().at(x, y, height);
      EXPECT_LE(here, bound) << i;
      dense += here > 0.0;
      flat += here > 0.0 && grass_volume.tiltAt(x, y) > 0.5;
      if (bound > 0.0) nearest = std::max(nearest, here / bound);
    }
    EXPECT_GT(dense, 2000);
    EXPECT_EQ(flat > 100, trodden) << flat;
    EXPECT_GT(nearest, 0.7);  // they are not much too high
  }
}

TEST(GrassVolume, EndsAtTheBorderOfItsMap) {
  const Lawn lawn;
  GrassVolume grass_volume;
  lawn.show(grass_volume);
  EXPECT_GT(grass_volume.extinction(Vec3(10.0, 19.9, 0.1), Vec3::UnitX()), 0.0);
  EXPECT_EQ(grass_volume.extinction(Vec3(10.0, 20.1, 0.1), Vec3::UnitX()), 0.0);
  EXPECT_EQ(grass_volume.extinction(Vec3(10.0, 10.0, 0.31), Vec3::UnitX()), 0.0);
  EXPECT_EQ(grass_volume.extinction(Vec3(10.0, 10.0, -0.01), Vec3::UnitX()), 0.0);
}

}  // namespace
}  // namespace vegetation_sim::scan
