// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "crowd/body/gait.h"
#include "reference/grass/blade_plain.h"
#include "reference/sensors/box_tree.h"
#include "scenes/forest/forest_fixture.h"
#include "sensors/sensor_scene.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/grass/blades/blade_batch.h"

namespace vegetation_sim::scan {

constexpr Nanoseconds START = 1700000000 * NANOSECONDS_PER_SECOND;

inline wind::Field breezeOf(const Vec3& velocity) {
  wind::Primitive out = forest::makeBreeze(1, velocity);
  out.turbulence = 0.2;
  out.epoch = START;
  return wind::Field({out});
}

/// Makes a replica of a forest whose branches move at every depth.
inline forest::ForestReplica movingForest(const forest::Layout& layout, const wind::Field& wind) {
  forest::ForestReplica out;
  out.setLayout(layout, forest::flatTerrain());
  out.setWind(wind);
  forest::StateUpdate update;
  update.stamp = START;
  update.key_frame = true;
  update.layout_hash = out.layoutHash();
  update.base = forest::LevelState::settled(forest::MAX_DEPTHS);
  out.apply(update);
  return out;
}

inline Vec3 randomDirection(const Random& random, std::uint64_t i, double low, double high) {
  const SinCos a = sinCosTurns(random.uniform(2 * i));
  const SinCos e = sinCos(random.uniform(2 * i + 1, low, high));
  return {e.cos * a.cos, e.cos * a.sin, e.sin};
}

inline bool same(const Hit& a, const Hit& b) {
  return a.distance == b.distance && a.label == b.label && a.plant == b.plant &&
         a.branch == b.branch && a.cosine == b.cosine;
}

/// A lawn with trodden ground.
struct Lawn {
  explicit Lawn(double height = 0.3, double density = 400.0) : layout(layoutOf(height, density)) {}
  static grass::Layout layoutOf(double height, double density) {
    grass::MapInput input;
    input.law.columns = input.law.rows = 11;
    input.height.value = height;
    input.density.value = density;
    grass::Layout out;
    out.map = std::make_shared<const grass::FeatureMap>(input);
    out.seed = 5;
    return out;
  }
  /// Treads a lane along x in the middle of the lawn.
  void treadLane() {
    grass::TreadLaw law;
    law.recovery = grass::PERMANENT_RECOVERY;
    law.radius = 1.0;
    law.reach = 1.6;
    for (int i = 0; i <= 40; ++i)
      tread.tread(1, law, {0.5 * i, 10.0}, START + fromSeconds(0.5 * i));
  }
  void show(GrassVolume& grass_volume, const wind::Field& wind = wind::Field(),
            double after = 60.0) const {
    grass_volume.update(layout, tread, std::make_shared<const terrain::HeightMap>(), wind,
                        Vec3(10.0, 10.0, 1.0), 30.0, START + fromSeconds(after));
  }
  grass::Layout layout;
  grass::TreadMap tread{layout.map->law(), grass::TreadSettings()};
};

/// The blades one by one as bars, which GrassVolume approximates.
class Blades {
 public:
  Blades(const Lawn& lawn, const wind::Field& wind, Nanoseconds stamp, int first, int last) {
    const terrain::HeightMap flat;
    grass::NodeWind air(*lawn.layout.map, flat);
    air.update(wind.at(stamp), {}, {first, last, first, last});
    for (int row = first; row <= last; ++row)
      for (int column = first; column <= last; ++column) {
        grass::Tile tile = makeTile(*lawn.layout.map, flat, lawn.layout.seed, column, row);
        grass::TileMotion motion;
        grass::CrushPatch crush;
        air.fill(tile, motion);
        lawn.tread.patch(column, row, stamp, crush);
        if (crush.cells > 0) motion.crush = &crush;
        add(tile, motion, lawn.layout.map->species()[0].species.width);
      }
    std::vector<Box> items;
    for (const Rod& rod : rods_) items.push_back(boxOf(rod));
    boxes_.build(items);
  }

  void meet(const Ray& ray, Hit& nearest) const {
    Meeting meeting;
    boxes_.visit(ray, nearest, [&](std::size_t i) {
      if (scan::meet(ray, rods_[i], nearest.distance, meeting))
        nearest = {meeting.distance, Label::GRASS, 0, -1, meeting.cosine};
    });
  }

 private:
  void add(const grass::Tile& tile, const grass::TileMotion& motion, double width) {
    std::vector<grass::BladeBlock> blocks(static_cast<std::size_t>(grass::blocksFor(tile.blades)));
    poseBladesPlain(tile, motion, tile.blades, blocks.data());
    const Vec3 corner(tile.x, tile.y, tile.z);
    const auto half = [&](int point) {
      const double way = static_cast<double>(point) / grass::LINKS;
      return 0.5 * width * (1.0 - way * way);
    };
    for (int blade = 0; blade < tile.blades; ++blade)
      for (int k = 0; k < grass::LINKS; ++k) {
        const grass::BladeBlock& b = blocks[static_cast<std::size_t>(blade / grass::BLOCK)];
        const int i = blade % grass::BLOCK;
        rods_.push_back(rodBetween(corner + Vec3(b.x[k][i], b.y[k][i], b.z[k][i]),
                                   corner + Vec3(b.x[k + 1][i], b.y[k + 1][i], b.z[k + 1][i]),
                                   half(k), half(k + 1)));
      }
  }

  std::vector<Rod> rods_;
  BoxTree boxes_;
};

}  // namespace vegetation_sim::scan
