// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "grass/lod/node_wind.h"
#include "sensors/geometry/ray.h"
#include "sensors/grass/grass_bounds.h"
#include "sensors/grass/grass_stand.h"
#include "sensors/media/beer_lambert.h"
#include "sensors/media/light_path.h"
#include "vegetation_sim/grass/grass_layout.h"
#include "vegetation_sim/grass/lod/colour_mask.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::scan {

class ColumnWalk;
struct BladeColumns;

/// Parts of the medium with one random number each: cubes, or upright columns as wide as a blade,
/// of which a picture shows single blades. Rays meet it equally often.
enum class GrassGrain { CUBES, BLADES };

/// Grass as a medium for rays: as dense as its blades, and as high as wind and treading leave them
/// (docs/scan.md).
class GrassVolume {
 public:
  /// Sets grass, trodden ground and wind at a stamp within `radius` of a place. `tread` must not
  /// change while rays are cast.
  void update(const grass::Layout& layout, const grass::TreadMap& tread,
              std::shared_ptr<const terrain::HeightMap> terrain, const wind::Field& wind,
              const Vec3& centre, double radius, Nanoseconds stamp);
  void clear() { tread_ = nullptr; }
  /// Sets the discs that colour the grass for cameras.
  void setColours(std::vector<grass::ColourMask> masks) { masks_ = std::move(masks); }
  const std::vector<grass::ColourMask>& colours() const { return masks_; }

  /// Cells in which the grass is evaluated: those that may stop the ray, or, slowly and with the
  /// same hits, all of them.
  enum class Cells { LIKELY, ALL };
  void meet(const Ray& ray, Hit& nearest, Cells cells = Cells::LIKELY) const;

  /// Does the same as meet() with BLADE_COLUMNS, and cubes beyond.
  void meetBlades(const Ray& ray, Hit& nearest, Cells cells = Cells::LIKELY) const;

  /// Adds the optical depth of the grass to a path of light.
  void addDepth(const Ray& ray, LightPath& path) const;

  const GrassBounds& bounds() const { return bounds_; }
  /// Whether there is grass at all; the functions below require it.
  bool isPresent() const { return tread_ != nullptr; }
  const grass::Layout& layout() const { return layout_; }
  /// Returns the height of a world place above the ground [m].
  double heightOf(const Vec3& place) const { return above(place); }
  /// Returns the optical depth of the grass above a place, by one evaluation half-way to its top.
  double depthAbove(const Vec3& place, const Vec3& direction) const;
  /// Returns how far the grass is trodden down [rad].
  double tiltAt(double x, double y) const;
  /// Height of the stubble, grass::UNCUT if there is none [m], and cut grass on it [kg/m^2].
  struct Cut {
    double height, swath;
  };
  Cut cutAt(double x, double y) const;
  /// Returns the extinction of a ray of this direction at a world place [1/m].
  double extinction(const Vec3& place, const Vec3& direction) const;

 private:
  struct Kind {
    double height{1.0}, spread{0.0}, width{0.0}, lean{0.0}, compliance{0.0};
  };
  void takeMap();
  double above(const Vec3& place) const;
  double topAt(double x, double y) const;
  GrassStand standAt(const Vec3& place) const;
  double extinctionAnew(const Vec3& middle, double height, const Vec3& direction) const;
  double extinctionIn(const Cell& cell, double height, const Vec3& direction) const;
  Vec3 airAt(double x, double y) const;
  template <class March>
  void visitLayer(const Ray& ray, const Hit& end, March&& march) const;
  template <bool LIKELY>
  double march(const Ray& ray, double from, Hit& nearest) const;
  double marchCubes(const Ray& ray, double from, Cells cells, Hit& nearest) const;
  double boundWithin(const Ray& ray, double from, double to) const;
  double marchBlades(const Ray& ray, double from, const BladeColumns& form, Cells cells,
                     Hit& nearest) const;
  double meetColumns(ColumnWalk& columns, double to, double bound, Hit& nearest) const;
  double marchLight(const Ray& ray, double from, LightPath& path) const;

  grass::Layout layout_;
  std::vector<grass::ColourMask> masks_;
  std::vector<Kind> kinds_;
  const grass::TreadMap* tread_{nullptr};  ///< null: no grass
  std::shared_ptr<const terrain::HeightMap> terrain_;
  grass::TileWindow window_;
  std::unique_ptr<grass::NodeWind> air_;
  bool still_{true}, flat_{true};
  double tallest_{0.0};  ///< height of the tallest blade of the map [m]
  GrassBounds bounds_;
  std::vector<float> tops_;  ///< [rows x columns] of tiles: upper bound of the height of blades [m]
  Nanoseconds stamp_{0};
  std::uint64_t version_{0};  ///< of the grass, different in all volumes
};

/// Mean cosine between a ray and the normals of blades of random orientation.
constexpr double BLADE_COSINE = 0.5;
/// Width of columns [m], and distance up to which they have it [m]; beyond, there are cubes.
struct BladeColumns {
  double width, reach;
};
/// Key of the random numbers of columns, with the seed of the grass.
constexpr std::uint32_t BLADE_SEED = 0x626c6164U;
constexpr std::array<BladeColumns, 2> BLADE_COLUMNS{{{0.006, 6.0}, {0.012, 12.0}}};

}  // namespace vegetation_sim::scan
