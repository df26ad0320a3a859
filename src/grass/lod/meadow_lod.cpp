// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/lod/meadow_lod.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {
namespace {

constexpr double MOST_COARSENESS = 64.0;
constexpr int COARSENESS_STEPS = 24;  // steps of bisection, for a precision of 1e-6

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

MeadowLod::MeadowLod(std::shared_ptr<const FeatureMap> map,
                     std::shared_ptr<const terrain::HeightMap> terrain, std::uint64_t seed,
                     const MeadowSettings& settings)
    : map_(std::move(map)), terrain_(std::move(terrain)), seed_(seed) {
  setSettings(settings);
  for (int row = 0; row < map_->tileRows(); ++row) {
    double most = 0.0;
    for (int column = 0; column < map_->tileColumns(); ++column) {
      const TileMeans f = map_->meansOf(column, row);
      if (!isBare(f)) most = std::max(most, omission(detailOf(f), TileModel::TEXTURE));
    }
    coarsest_.push_back(most);
  }
}

void MeadowLod::setSettings(const MeadowSettings& settings) {
  MeadowSettings wanted = settings;
  Faults faults;
  FieldChecker checker("meadow: ", faults);
  describe(checker, wanted);
  faults.throwIfAny();
  settings_ = wanted;
}

Vec3 MeadowLod::centreOf(int row, int column) const {
  const MapLaw& law = map_->law();
  const double x = law.origin_x + law.resolution * (column + 0.5);
  const double y = law.origin_y + law.resolution * (row + 0.5);
  return {x, y, terrain_->height(x, y)};
}

// Returns the largest scale of any viewpoint, from the nearest point of the tile.
double MeadowLod::scaleOf(const Vec3& centre) const {
  double scale = 0.0;
  const double half = 0.70710678 * map_->law().resolution;
  for (const Viewpoint& eye : viewpoints_)
    scale = std::max(scale, pixelsPerMetre(eye, length(eye.position - centre) - half));
  return scale;
}

bool MeadowLod::isSeen(const Vec3& centre) const {
  const double radius = 0.75 * map_->law().resolution + map_->tallest();
  return std::any_of(viewpoints_.begin(), viewpoints_.end(),
                     [&](const Viewpoint& eye) { return sees(eye, centre, radius); });
}

// Returns the distance from which on all tiles of a row are textures for any number of blades.
double MeadowLod::farthestOf(int row, const Viewpoint& eye) const {
  const double pixels = HYSTERESIS * settings_.tolerance;
  const double apart = coarsest_[static_cast<std::size_t>(row)] * eye.pixels_per_radian / pixels;
  return std::min(settings_.farthest, apart + 2.0 * map_->law().resolution);
}

// Returns the columns of a row that are near enough to a viewpoint.
std::pair<int, int> MeadowLod::columnsIn(int row) const {
  const MapLaw& law = map_->law();
  int first = map_->tileColumns(), last = -1;
  const double y = law.origin_y + law.resolution * (row + 0.5);
  for (const Viewpoint& eye : viewpoints_) {
    const double dy = y - eye.position.y(), far = farthestOf(row, eye);
    if (!(dy * dy < far * far)) continue;
    const double half = std::sqrt(far * far - dy * dy), x = eye.position.x() - law.origin_x;
    first = std::min(first, clamped((x - half) / law.resolution, 0, map_->tileColumns() - 1));
    last = std::max(last, clamped((x + half) / law.resolution, 0, map_->tileColumns() - 1));
  }
  return {first, last};
}

// Makes the candidate of a tile from its last level.
MeadowLod::Candidate MeadowLod::candidateOf(const TileLevel& level) const {
  Candidate out;
  out.level = level;
  const TileMeans f = map_->meansOf(level.column, level.row);
  if (isBare(f)) return out;
  const Vec3 centre = centreOf(level.row, level.column);
  out.detail = detailOf(f);
  out.scale = scaleOf(centre);
  out.wanted = chooseTileModel(out.detail, out.scale, settings_.tolerance, level.tier.target);
  const double size = map_->law().resolution;
  if (out.wanted == TileModel::BLADES && isSeen(centre)) out.blades = f.density * size * size;
  return out;
}

// Returns all tiles that want to be more than a texture or still are, in order.
std::vector<MeadowLod::Candidate> MeadowLod::findCandidates() const {
  std::vector<Candidate> out;
  out.reserve(levels_.size() + 64);
  auto old = levels_.cbegin();
  const auto leave = [&](int row, int column) {
    for (; old != levels_.cend() && isBefore(*old, row, column); ++old) out.push_back({*old});
  };
  for (int row = 0; row < map_->tileRows(); ++row) {
    const auto [first, last] = columnsIn(row);
    for (int column = first; column <= last; ++column) {
      leave(row, column);
      const bool known = old != levels_.cend() && old->row == row && old->column == column;
      const Candidate tile = candidateOf(known ? *old++ : TileLevel{row, column, {}});
      if (known || tile.wanted != TileModel::TEXTURE) out.push_back(tile);
    }
  }
  leave(map_->tileRows(), 0);
  return out;
}

// Return the number of drawn blades of a tile, and its model, at `coarseness` times the tolerance.
double MeadowLod::bladesAt(const Candidate& tile, double coarseness) const {
  if (!(tile.blades > 0.0) || modelAt(tile, coarseness) != TileModel::BLADES) return 0.0;
  return tile.blades * bladeShare(tile.detail, tile.scale, settings_.tolerance * coarseness);
}

TileModel MeadowLod::modelAt(const Candidate& tile, double coarseness) const {
  if (tile.wanted == TileModel::TEXTURE) return TileModel::TEXTURE;
  return chooseTileModel(tile.detail, tile.scale, settings_.tolerance * coarseness,
                         tile.level.tier.target);
}

// Returns the least factor on the tolerance that keeps the limit for blades: tiles with a larger
// omission have blades. Hysteresis makes tiles with blades count as farther away, so that the same
// view gives the same factor again.
double MeadowLod::coarsenessFor(const std::vector<Candidate>& tiles) const {
  std::vector<const Candidate*> bearing;
  for (const Candidate& tile : tiles)
    if (tile.blades > 0.0) bearing.push_back(&tile);
  const auto fits = [&](double coarseness) {
    double blades = 0.0;
    for (const Candidate* tile : bearing) blades += bladesAt(*tile, coarseness);
    return blades <= settings_.most_blades;
  };
  double low = 1.0, high = MOST_COARSENESS;
  if (fits(low)) return low;
  for (int i = 0; i < COARSENESS_STEPS; ++i) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? high : low) = middle;
  }
  return high;
}

void MeadowLod::addToBalance(const Candidate& tile, TileModel tier) {
  if (!(tile.scale > 0.0)) return;  // bare or out of range
  const double error = tile.scale * omission(tile.detail, tier);
  balance_.cost += bladesAt(tile, coarseness_);
  balance_.wanted += bladesAt(tile, 1.0);
  balance_.largest = std::max(balance_.largest, error);
  balance_.largest_metres = std::max(balance_.largest_metres, omission(tile.detail, tier));
  balance_.over += error > settings_.tolerance ? 1 : 0;
  balance_.held_back += tier < tile.wanted ? 1 : 0;
  ++balance_.counts[static_cast<std::size_t>(tier)];
}

void MeadowLod::chooseLevels(Nanoseconds stamp) {
  const std::vector<Candidate> tiles = findCandidates();
  coarseness_ = coarsenessFor(tiles);
  balance_ = TierAllocation();
  levels_.clear();
  for (const Candidate& tile : tiles) {
    const TileModel tier = modelAt(tile, coarseness_);
    addToBalance(tile, tier);
    TileLevel level = tile.level;
    setTileModel(level.tier, tier, stamp, settings_.transition);
    if (tier != TileModel::TEXTURE || placeAt(level.tier, stamp, settings_.transition) > 0.0)
      levels_.push_back(level);
  }
}

void MeadowLod::advance(Nanoseconds stamp) {
  if (stamp < stamp_) levels_.clear();
  stamp_ = stamp;
  chooseLevels(stamp);
}

std::vector<TileView> MeadowLod::viewOf(const Viewpoint& eye, Nanoseconds stamp) const {
  std::vector<TileView> out;
  const double size = map_->law().resolution, tolerance = settings_.tolerance * coarseness_;
  for (const TileLevel& level : levels_) {
    const double place = placeAt(level.tier, stamp, settings_.transition);
    if (!(place > 0.0)) continue;
    const Vec3 centre = centreOf(level.row, level.column);
    const TileMeans f = map_->meansOf(level.column, level.row);
    if (!sees(eye, centre, 0.75 * size + map_->tallest())) continue;
    const Vec3 view = eye.position - centre;
    const double scale = pixelsPerMetre(eye, length(view) - 0.70710678 * size);
    const double flat = std::sqrt(view.x() * view.x() + view.y() * view.y());
    TileView tile{level.row, level.column, morphAt(place), LINKS, 1.0, arcTangent(view.z(), flat),
                  1};
    tile.segments = bladeSegments(f.height, scale, tolerance);
    tile.layers = layerCount(f.height, scale, tolerance);
    tile.share = bladeShare(detailOf(f), scale, tolerance);
    out.push_back(tile);
  }
  return out;
}

TileWindow MeadowLod::windowOf(const std::vector<TileView>& views) {
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

Tile MeadowLod::tileAt(const TileView& view, const NodeWind& air, const TreadMap& tread,
                       Nanoseconds stamp, CrushPatch& patch, TileMotion& motion) const {
  Tile tile = makeTile(*map_, *terrain_, seed_, view.column, view.row);
  air.fill(tile, motion);
  tread.patch(view.column, view.row, stamp, patch);
  motion.crush = patch.cells > 0 ? &patch : nullptr;
  return tile;
}

MeadowLodSnapshot MeadowLod::snapshot() const {
  return {stamp_, coarseness_, levels_, viewpoints_};
}

void MeadowLod::restore(MeadowLodSnapshot snapshot) {
  stamp_ = snapshot.stamp;
  coarseness_ = snapshot.coarseness;
  levels_ = std::move(snapshot.levels);
  viewpoints_ = std::move(snapshot.viewpoints);
}

void MeadowLodSnapshot::addTo(Hash& hash) const {
  const auto add = [&](auto value) { hash.add(static_cast<std::uint64_t>(value)); };
  add(stamp);
  hash.add(coarseness);
  for (const TileLevel& level : levels) {
    for (const int value : {level.row, level.column, static_cast<int>(level.tier.target)})
      add(value);
    add(level.tier.since);
    hash.add(double{level.tier.place});
  }
  for (const Viewpoint& eye : viewpoints) {
    hash.add(eye.position);
    hash.add(eye.forward);
    hash.add(eye.pixels_per_radian);
    hash.add(eye.cone_cosine);
  }
}

std::uint64_t MeadowLodSnapshot::hash() const {
  Hash hash;
  addTo(hash);
  return hash.value();
}

}  // namespace vegetation_sim::grass
