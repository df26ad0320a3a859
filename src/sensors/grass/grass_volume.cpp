// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/grass/grass_volume.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "sensors/geometry/box.h"
#include "sensors/media/beer_lambert.h"
#include "sensors/media/cell_walk.h"
#include "terrain/ground_ray.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

int indexOf(double x, double origin, double resolution, int most) {
  return static_cast<int>(std::clamp(std::floor((x - origin) / resolution), 0.0, double(most)));
}

Vec3 middleOf(const Cell& cell) {
  return {GRASS_CELL * (cell.x + 0.5), GRASS_CELL * (cell.y + 0.5), 0.0};
}

grass::TileWindow windowAround(const grass::FeatureMap& map, const Vec3& centre, double radius) {
  const grass::MapLaw& law = map.law();
  const auto column = [&](double x) {
    return indexOf(x, law.origin_x, law.resolution, map.tileColumns() - 1);
  };
  const auto row = [&](double y) {
    return indexOf(y, law.origin_y, law.resolution, map.tileRows() - 1);
  };
  return {column(centre.x() - radius), column(centre.x() + radius), row(centre.y() - radius),
          row(centre.y() + radius)};
}

}  // namespace

void GrassVolume::update(const grass::Layout& layout, const grass::TreadMap& tread,
                         std::shared_ptr<const terrain::HeightMap> terrain, const wind::Field& wind,
                         const Vec3& centre, double radius, Nanoseconds stamp) {
  const bool other_map = layout_.map != layout.map || tops_.empty();
  layout_ = layout;
  tread_ = &tread;
  terrain_ = std::move(terrain);
  flat_ = terrain_->isFlat();
  stamp_ = stamp;
  if (other_map) takeMap();
  window_ = windowAround(*layout_.map, centre, radius);
  air_ = std::make_unique<grass::NodeWind>(*layout_.map, *terrain_);
  const wind::Instant instant = wind.at(stamp);
  still_ = instant.breezes == 0 && instant.terms.empty();
  if (!still_) air_->update(instant, {}, window_);
  bounds_.setWind(still_ ? nullptr : air_.get(), window_);
  bounds_.setTread(tread);
  static std::atomic<std::uint64_t> versions{0};
  version_ = ++versions;
}

void GrassVolume::takeMap() {
  const grass::FeatureMap& map = *layout_.map;
  tallest_ = map.tallest();
  kinds_.clear();
  double factor = 0.0;
  for (const grass::SpeciesInput& input : map.species()) {
    const grass::Species& s = input.species;
    kinds_.push_back({s.height, s.height_spread, s.width, s.lean, s.compliance});
    factor = std::max(factor, s.height);
  }
  bounds_.setMap(map);
  tops_.clear();
  for (int row = 0; row < map.tileRows(); ++row)
    for (int column = 0; column < map.tileColumns(); ++column) {
      double height = 0.0;
      for (int corner = 0; corner < 4; ++corner)
        height = std::max(height, map.node(column + corner % 2, row + corner / 2).height);
      tops_.push_back(static_cast<float>(factor * height));
    }
}

// Returns the upper bound of the height of blades, or -1 outside of the map.
double GrassVolume::topAt(double x, double y) const {
  const grass::MapLaw& law = layout_.map->law();
  const double u = (x - law.origin_x) / law.resolution, v = (y - law.origin_y) / law.resolution;
  if (!(u >= 0.0 && v >= 0.0 && u < law.columns - 1 && v < law.rows - 1)) return -1.0;
  const std::size_t row = static_cast<std::size_t>(v), column = static_cast<std::size_t>(u);
  return tops_[row * static_cast<std::size_t>(law.columns - 1) + column];
}

double GrassVolume::depthAbove(const Vec3& place, const Vec3& direction) const {
  constexpr double LEAST_RISE = 0.1;  // of the direction, so that the way ends near the place
  const double rise =
      std::min(topAt(place.x(), place.y()), cutAt(place.x(), place.y()).height) - above(place);
  if (!(rise > 0.0)) return 0.0;
  const double way = rise / std::max(direction.z(), LEAST_RISE);
  return extinction(place + 0.5 * way * direction, direction) * way;
}

double GrassVolume::tiltAt(double x, double y) const {
  return double{tread_->at({x, y}, stamp_).tilt};
}

GrassVolume::Cut GrassVolume::cutAt(double x, double y) const {
  const grass::CutNode node = tread_->cuts().at({x, y});
  return {double{node.height}, node.swath};
}

double GrassVolume::above(const Vec3& place) const {
  return flat_ ? place.z() : place.z() - terrain_->height(place.x(), place.y());
}

// Interpolates between the corners of the tile, like poseBlades().
Vec3 GrassVolume::airAt(double x, double y) const {
  const grass::MapLaw& law = layout_.map->law();
  const double u = (x - law.origin_x) / law.resolution, v = (y - law.origin_y) / law.resolution;
  const int column = static_cast<int>(std::floor(u)), row = static_cast<int>(std::floor(v));
  if (still_ || !window_.has(column, row)) return Vec3::Zero();
  const double p = u - column, q = v - row;
  return (1.0 - q) * ((1.0 - p) * air_->at(column, row) + p * air_->at(column + 1, row)) +
         q * ((1.0 - p) * air_->at(column, row + 1) + p * air_->at(column + 1, row + 1));
}

double GrassVolume::extinction(const Vec3& place, const Vec3& direction) const {
  const Cell cell = cellAt(place, GRASS_CELL);
  return extinctionIn(cell, above(place), direction);
}

double GrassVolume::extinctionIn(const Cell& cell, double height, const Vec3& direction) const {
  thread_local StandCache cache;
  const GrassStand& stand =
      cache.at(version_, cell.x, cell.y, [&] { return standAt(middleOf(cell)); });
  return stand.extinction(height, direction.z() * direction.z());
}

double GrassVolume::extinctionAnew(const Vec3& middle, double height, const Vec3& direction) const {
  if (height > topAt(middle.x(), middle.y())) return 0.0;
  return standAt(middle).extinction(height, direction.z() * direction.z());
}

// Lean has a random direction: its square is the sum of two means of 1/6.
GrassStand GrassVolume::standAt(const Vec3& place) const {
  const grass::Features here = layout_.map->at(place.x(), place.y());
  if (!(here.density > 0.0)) return {};
  GrassStand out(cutAt(place.x(), place.y()).height);
  const double tilt = tiltAt(place.x(), place.y());
  const Vec3 air = airAt(place.x(), place.y());
  double shares = 0.0;
  for (std::size_t k = 0; k < kinds_.size(); ++k) shares += here.mix[k];
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    if (!(here.mix[k] > 0.0)) continue;
    const Kind& kind = kinds_[k];
    const grass::Point blown = grass::bendIn(air, kind.compliance);
    const double lean = kind.lean * here.shape;
    const double bend =
        softLimit(std::sqrt(blown.x * blown.x + blown.y * blown.y + lean * lean / 3.0),
                  grass::BEND_KNEE, grass::BEND_LIMIT);
    const double left = bend * (1.0 - tilt / grass::BEND_LIMIT);
    const double both = std::sqrt(tilt * tilt + left * left);
    const double hinge = tilt + left > 0.0 ? both * tilt / (tilt + left) : 0.0;
    const double rise = sinCos(hinge + 0.5 * (both - hinge)).cos;
    const double most = here.height * kind.height;
    out.add({static_cast<float>(here.density * here.mix[k] / shares * kind.width / rise),
             static_cast<float>(rise), static_cast<float>(most * (1.0 - kind.spread)),
             static_cast<float>(most)});
  }
  return out;
}

// Enters the layer of the grass, marches through it, and may enter it again. @param march returns
// where the ray leaves the layer; it may reduce the distance of the end.
template <class March>
void GrassVolume::visitLayer(const Ray& ray, const Hit& end, March&& march) const {
  if (!tread_) return;
  double from = 0.0;
  while (from < end.distance) {
    const Vec3 top = ray.at(from) - Vec3(0.0, 0.0, tallest_);
    if (above(top) > 0.0) {
      Vec3 entry;
      const double left = std::min(end.distance - from, 1e4);
      if (!terrain::meetGround(*terrain_, top, ray.direction, left, entry)) return;
      from += length(entry - top);
    }
    from = march(from) + GRASS_CELL;
  }
}

void GrassVolume::meet(const Ray& ray, Hit& nearest, Cells cells) const {
  visitLayer(ray, nearest, [&](double from) { return marchCubes(ray, from, cells, nearest); });
}

void GrassVolume::meetBlades(const Ray& ray, Hit& nearest, Cells cells) const {
  visitLayer(ray, nearest, [&](double from) {
    for (const BladeColumns& form : BLADE_COLUMNS) {
      if (from >= form.reach) continue;
      from = marchBlades(ray, from, form, cells, nearest);
      if (from < form.reach) return from;
    }
    return marchCubes(ray, from, cells, nearest);
  });
}

void GrassVolume::addDepth(const Ray& ray, LightPath& path) const {
  visitLayer(ray, path.end(), [&](double from) { return marchLight(ray, from, path); });
}

double GrassVolume::marchCubes(const Ray& ray, double from, Cells cells, Hit& nearest) const {
  return cells == Cells::LIKELY ? march<true>(ray, from, nearest)
                                : march<false>(ray, from, nearest);
}

// Returns the distance at which the ray leaves the layer or hits a blade.
template <bool LIKELY>
double GrassVolume::march(const Ray& ray, double from, Hit& nearest) const {
  CellWalk walk(ray, from, GRASS_CELL);
  const auto key = static_cast<std::uint32_t>(layout_.seed);
  for (; from < nearest.distance; walk.advance()) {
    const double start = from, to = std::min(walk.end(), nearest.distance);
    from = to;
    const double height = above(ray.at(0.5 * (start + to)));
    if (height > tallest_) return start;
    const Vec3 middle = middleOf(walk.cell());
    const double bound = LIKELY ? bounds_.at(middle.x(), middle.y(), height) : Box::ENDLESS;
    if (bound <= 0.0) continue;
    const double share = shareOf(walk.cell(), key);
    if (LIKELY && !mayBeBelow(bound * (to - start), share)) continue;
    const double here = LIKELY ? extinctionIn(walk.cell(), height, ray.direction)
                               : extinctionAnew(middle, height, ray.direction);
    const double way = here > 0.0 ? depthAt(share) / here : Box::ENDLESS;
    if (!(start + way < to)) continue;
    nearest = {start + way, Label::GRASS, 0, -1, BLADE_COSINE};
    return nearest.distance;
  }
  return from;
}

// Returns the distance at which the light leaves the layer or ends.
double GrassVolume::marchLight(const Ray& ray, double from, LightPath& path) const {
  CellWalk walk(ray, from, GRASS_CELL);
  for (; from < path.end().distance; walk.advance()) {
    const double start = from, to = std::min(walk.end(), path.end().distance);
    from = to;
    const double height = above(ray.at(0.5 * (start + to)));
    if (height > tallest_) return start;
    path.add(extinctionIn(walk.cell(), height, ray.direction) * (to - start));
  }
  return from;
}

}  // namespace vegetation_sim::scan
