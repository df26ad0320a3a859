// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/grass/meadow.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "vegetation_sim/common/hash.h"
#include "vegetation_sim/common/math.h"

namespace vegetation_sim::grass {
namespace {

int clamped(double x, int low, int high) {
  return static_cast<int>(std::min(double(high), std::max(double(low), x)));
}

bool isBefore(const TileLevel& level, int row, int column) {
  return std::tie(level.row, level.column) < std::tie(row, column);
}

bool isBare(const TileMeans& f) {
  return !(f.density > 0.0 && f.height > 0.0);
}

TileDetail detailOf(const TileMeans& f) {
  return {1.0 / std::sqrt(std::max(f.density, 1e-6)), f.height};
}

}  // namespace

void describe(FieldVisitor& v, MeadowSettings& s) {
  v.number("tolerance", s.tolerance, "pixel", {0.1, 100.0});
  v.number("transition", s.transition, "s", {0.0, 60.0});
  v.number("farthest", s.farthest, "m", {1.0, 1e4});
  v.number("most_blades", s.most_blades, "", {1e3, 1e8});
}

Meadow::Meadow(std::shared_ptr<const FeatureMap> map,
               std::shared_ptr<const terrain::HeightMap> terrain, std::uint64_t seed,
               const MeadowSettings& settings, const TreadSettings& tread)
    : map_(std::move(map)), terrain_(std::move(terrain)), seed_(seed), tread_(map_->law(), tread) {
  setSettings(settings);
  for (int row = 0; row < map_->tileRows(); ++row) {
    double most = 0.0;
    for (int column = 0; column < map_->tileColumns(); ++column) {
      const TileMeans f = map_->meansOf(column, row);
      if (!isBare(f)) most = std::max(most, omission(detailOf(f), Rung::TEXTURE));
    }
    coarsest_.push_back(most);
  }
}

void Meadow::setSettings(const MeadowSettings& settings) {
  MeadowSettings wanted = settings;
  Faults faults;
  FieldChecker checker("meadow: ", faults);
  describe(checker, wanted);
  faults.throwIfAny();
  settings_ = wanted;
}

Vec3 Meadow::centreOf(int row, int column) const {
  const MapLaw& law = map_->law();
  const double x = law.origin_x + law.resolution * (column + 0.5);
  const double y = law.origin_y + law.resolution * (row + 0.5);
  return {x, y, terrain_->height(x, y)};
}

// Largest scale of any eye, from the nearest point of the tile.
double Meadow::scaleOf(const Vec3& centre) const {
  double scale = 0.0;
  const double half = 0.70710678 * map_->law().resolution;
  for (const Eye& eye : eyes_)
    scale = std::max(scale, pixelsPerMetre(eye, length(eye.position - centre) - half));
  return scale;
}

bool Meadow::isSeen(const Vec3& centre) const {
  const double radius = 0.75 * map_->law().resolution + map_->tallest();
  return std::any_of(eyes_.begin(), eyes_.end(),
                     [&](const Eye& eye) { return sees(eye, centre, radius); });
}

// From where on all tiles of a row are surely textures.
double Meadow::farthestOf(int row, const Eye& eye) const {
  const double pixels = HYSTERESIS * settings_.tolerance * coarseness_;
  const double apart = coarsest_[static_cast<std::size_t>(row)] * eye.pixels_per_radian / pixels;
  return std::min(settings_.farthest, apart + 2.0 * map_->law().resolution);
}

// Columns of a row that any eye is near enough to.
std::pair<int, int> Meadow::columnsIn(int row) const {
  const MapLaw& law = map_->law();
  int first = map_->tileColumns(), last = -1;
  const double y = law.origin_y + law.resolution * (row + 0.5);
  for (const Eye& eye : eyes_) {
    const double dy = y - eye.position.y(), far = farthestOf(row, eye);
    if (!(dy * dy < far * far)) continue;
    const double half = std::sqrt(far * far - dy * dy), x = eye.position.x() - law.origin_x;
    first = std::min(first, clamped((x - half) / law.resolution, 0, map_->tileColumns() - 1));
    last = std::max(last, clamped((x + half) / law.resolution, 0, map_->tileColumns() - 1));
  }
  return {first, last};
}

// The rung of a tile within the tolerance that the budget leaves; notes what it costs and is off.
Rung Meadow::chooseTile(int row, int column, Rung current) {
  const TileMeans f = map_->meansOf(column, row);
  if (isBare(f)) return Rung::TEXTURE;
  const Vec3 centre = centreOf(row, column);
  const TileDetail detail = detailOf(f);
  const double scale = scaleOf(centre), size = map_->law().resolution;
  const double tolerance = settings_.tolerance * coarseness_;
  const Rung rung = chooseRung(detail, scale, tolerance, current);
  const Rung wanted = chooseRung(detail, scale, settings_.tolerance, current);
  const bool seen = wanted == Rung::BLADES && isSeen(centre);
  const auto blades = [&](Rung of, double within) {
    return seen && of == Rung::BLADES ? f.density * size * size * bladeShare(detail, scale, within)
                                      : 0.0;
  };
  const double error = scale * omission(detail, rung);
  balance_.cost += blades(rung, tolerance);
  balance_.wanted += blades(wanted, settings_.tolerance);
  balance_.largest = std::max(balance_.largest, error);
  balance_.over += error > settings_.tolerance ? 1 : 0;
  balance_.held_back += rung < wanted ? 1 : 0;
  ++balance_.counts[static_cast<std::size_t>(rung)];
  return rung;
}

// Levels of one row in order, old ones taken along.
void Meadow::chooseRow(int row, std::vector<TileLevel>::const_iterator& old, Nanoseconds stamp,
                       std::vector<TileLevel>& out) {
  const auto [first, last] = columnsIn(row);
  const auto keep = [&](TileLevel level, Rung rung) {
    setRung(level.rung, rung, stamp, settings_.transition);
    if (rung != Rung::TEXTURE || placeAt(level.rung, stamp, settings_.transition) > 0.0)
      out.push_back(level);
  };
  for (int column = first; column <= last; ++column) {
    for (; old != levels_.end() && isBefore(*old, row, column); ++old) keep(*old, Rung::TEXTURE);
    TileLevel level{row, column, {}};
    if (old != levels_.end() && old->row == row && old->column == column) level = *old++;
    keep(level, chooseTile(row, column, level.rung.target));
  }
}

void Meadow::advance(Nanoseconds stamp) {
  if (stamp < stamp_) {
    tread_.rewind(stamp);
    levels_.clear();
    coarseness_ = 1.0;
  }
  const Nanoseconds before = std::exchange(stamp_, stamp);
  std::vector<TileLevel> next;
  next.reserve(levels_.size() + 64);
  auto old = levels_.cbegin();
  balance_ = Balance();
  for (int row = 0; row < map_->tileRows(); ++row) chooseRow(row, old, stamp, next);
  for (; old != levels_.cend(); ++old) {
    TileLevel level = *old;
    setRung(level.rung, Rung::TEXTURE, stamp, settings_.transition);
    if (placeAt(level.rung, stamp, settings_.transition) > 0.0) next.push_back(level);
  }
  levels_ = std::move(next);
  // Blades grow about as the inverse of the tolerance; half the way at a time cannot overshoot.
  const double wanted = coarseness_ * std::sqrt(balance_.cost / settings_.most_blades);
  coarseness_ = std::min(64.0, std::max(1.0, wanted));
  // A look through all the trodden ground: once a second is enough.
  if (stamp / NANOSECONDS_PER_SECOND != before / NANOSECONDS_PER_SECOND) tread_.prune(stamp);
}

std::vector<TileView> Meadow::viewOf(const Eye& eye, Nanoseconds stamp) const {
  std::vector<TileView> out;
  const double size = map_->law().resolution, tolerance = settings_.tolerance * coarseness_;
  for (const TileLevel& level : levels_) {
    const double place = placeAt(level.rung, stamp, settings_.transition);
    if (!(place > 0.0)) continue;
    const Vec3 centre = centreOf(level.row, level.column);
    const TileMeans f = map_->meansOf(level.column, level.row);
    if (!sees(eye, centre, 0.75 * size + map_->tallest())) continue;
    const Vec3 view = eye.position - centre;
    const double scale = pixelsPerMetre(eye, length(view) - 0.70710678 * size);
    const double flat = std::sqrt(view.x() * view.x() + view.y() * view.y());
    TileView tile{level.row, level.column, morphAt(place), LINKS, 1.0, arcTangent(view.z(), flat)};
    tile.segments = bladeSegments(f.height, scale, tolerance);
    tile.share = bladeShare(detailOf(f), scale, tolerance);
    out.push_back(tile);
  }
  return out;
}

TileWindow Meadow::windowOf(const std::vector<TileView>& views) {
  TileWindow out;
  bool any = false;
  for (const TileView& v : views) {
    if (!any) out = {v.column, v.column, v.row, v.row};
    any = true;
    out.first_column = std::min(out.first_column, v.column);
    out.last_column = std::max(out.last_column, v.column);
    out.first_row = std::min(out.first_row, v.row);
    out.last_row = std::max(out.last_row, v.row);
  }
  return out;
}

Tile Meadow::tileAt(const TileView& view, const NodeAir& air, Nanoseconds stamp, CrushPatch& patch,
                    TileMotion& motion) const {
  Tile tile = makeTile(*map_, *terrain_, seed_, view.column, view.row);
  air.fill(tile, motion);
  tread_.patch(view.column, view.row, stamp, patch);
  motion.crush = patch.cells > 0 ? &patch : nullptr;
  return tile;
}

MeadowMemory Meadow::memory() const {
  return {stamp_, coarseness_, levels_, eyes_, tread_.state()};
}

void Meadow::restore(MeadowMemory memory) {
  stamp_ = memory.stamp;
  coarseness_ = memory.coarseness;
  levels_ = std::move(memory.levels);
  eyes_ = std::move(memory.eyes);
  tread_.restore(std::move(memory.tread));
}

std::size_t Meadow::bytes() const {
  return tread_.bytes() + levels_.capacity() * sizeof(TileLevel);
}

std::uint64_t MeadowMemory::hash() const {
  Hash hash;
  const auto add = [&](auto value) { hash.add(static_cast<std::uint64_t>(value)); };
  add(stamp);
  hash.add(coarseness);
  for (const TileLevel& level : levels) {
    for (const int value : {level.row, level.column, static_cast<int>(level.rung.target)})
      add(value);
    add(level.rung.since);
    hash.add(double{level.rung.place});
  }
  for (const Eye& eye : eyes) {
    hash.add(eye.position);
    hash.add(eye.forward);
    hash.add(eye.pixels_per_radian);
    hash.add(eye.cone_cosine);
  }
  add(tread.hash());
  return hash.value();
}

}  // namespace vegetation_sim::grass
