// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/terrain/height_map.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/core/math/hash.h"

namespace vegetation_sim::terrain {
namespace {

/// Position of a coordinate on one axis of the grid.
struct Place {
  int index;        ///< Lower sample of the interval.
  double fraction;  ///< Fraction of the way to the upper one, 0 to 1.
  bool inside;
};

Place placeAt(double coordinate, double origin, double resolution, int samples) {
  const double last = samples - 1;
  const double u = (coordinate - origin) / resolution;
  if (!(u >= 0.0)) return {0, 0.0, false};
  const int interval = static_cast<int>(std::min(std::floor(u), std::max(0.0, last - 1.0)));
  return {interval, std::min(u, last) - interval, u <= last};
}

void checkImage(const GreyImage& image, Faults& faults) {
  const bool sides = image.columns >= 1 && image.columns <= LONGEST_SIDE && image.rows >= 1 &&
                     image.rows <= LONGEST_SIDE;
  if (!sides || image.samples.size() != static_cast<std::size_t>(image.columns) * image.rows)
    faults.add("terrain: image has " + std::to_string(image.samples.size()) + " samples for " +
               std::to_string(image.columns) + " x " + std::to_string(image.rows) +
               ", each side 1 to " + std::to_string(LONGEST_SIDE));
  if (image.white < 1) faults.add("terrain: image has no largest sample");
}

void checkHeights(const HeightMapLaw& law, const std::string& name, Faults& faults) {
  if (law.height_max < law.height_min)
    faults.add(name + ": height_max = " + std::to_string(law.height_max) +
               " m is below height_min = " + std::to_string(law.height_min) + " m");
}

}  // namespace

void describe(FieldVisitor& v, HeightMapLaw& law) {
  v.number("resolution", law.resolution, "m", {1e-3, 1e3});
  v.vector("origin", law.origin, "m", {-1e6, 1e6});
  v.number("height_min", law.height_min, "m", {-1e4, 1e4});
  v.number("height_max", law.height_max, "m", {-1e4, 1e4});
}

/// The four samples around a point, and the position of the point among them.
struct HeightMap::Cell {
  double h00, h10, h01, h11;  ///< [m], the first digit along x.
  double u, v;                ///< Fraction of the way along x and y, 0 to 1.
  bool inside_x, inside_y;
};

inline double HeightMap::sample(int column, int row_from_south) const {
  column = std::min(column, image_.columns - 1);
  const int row = image_.rows - 1 - std::min(row_from_south, image_.rows - 1);
  const std::size_t index = static_cast<std::size_t>(row) * image_.columns + column;
  return base_ + scale_ * image_.samples[index];
}

inline HeightMap::Cell HeightMap::cellAt(double x, double y) const {
  const Place px = placeAt(x, law_.origin.x(), law_.resolution, image_.columns);
  const Place py = placeAt(y, law_.origin.y(), law_.resolution, image_.rows);
  return {sample(px.index, py.index),
          sample(px.index + 1, py.index),
          sample(px.index, py.index + 1),
          sample(px.index + 1, py.index + 1),
          px.fraction,
          py.fraction,
          px.inside,
          py.inside};
}

HeightMap::HeightMap(const HeightMapLaw& law, GreyImage image)
    : law_(law), image_(std::move(image)) {
  Faults faults;
  FieldChecker checker("terrain: ", faults);
  describe(checker, law_);
  checkHeights(law_, "terrain", faults);
  checkImage(image_, faults);
  faults.throwIfAny();

  base_ = law_.origin.z() + law_.height_min;
  scale_ = (law_.height_max - law_.height_min) / image_.white;
  const auto [low, high] = std::minmax_element(image_.samples.begin(), image_.samples.end());
  bounds_ = {law_.origin.x(),       law_.origin.x() + law_.resolution * (image_.columns - 1),
             law_.origin.y(),       law_.origin.y() + law_.resolution * (image_.rows - 1),
             base_ + scale_ * *low, base_ + scale_ * *high};
  steepest_ = findSteepest();
  findTops();
  Hash hash;
  FieldHasher hasher(hash);
  describe(hasher, law_);
  hash.add(static_cast<std::uint64_t>(image_.columns));
  hash.add(static_cast<std::uint64_t>(image_.white));
  for (const auto s : image_.samples) hash.add(static_cast<std::uint64_t>(s));
  hash_ = hash.value();
}

// Between samples, the derivative along an axis is a mean of the slopes of two edges along it.
double HeightMap::findSteepest() const {
  double most_x = 0.0, most_y = 0.0;
  for (int row = 0; row < image_.rows; ++row)
    for (int column = 0; column < image_.columns; ++column) {
      const double here = sample(column, row);
      most_x = std::max(most_x, std::fabs(sample(column + 1, row) - here));
      most_y = std::max(most_y, std::fabs(sample(column, row + 1) - here));
    }
  return std::sqrt(most_x * most_x + most_y * most_y) / law_.resolution;
}

void HeightMap::findTops() {
  const auto blocksOf = [](int samples) { return std::max(1, (samples - 2) / BLOCK + 1); };
  block_columns_ = blocksOf(image_.columns);
  block_rows_ = blocksOf(image_.rows);
  for (int block_row = 0; block_row < block_rows_; ++block_row)
    for (int block_column = 0; block_column < block_columns_; ++block_column) {
      double top = -ENDLESS;
      for (int row = block_row * BLOCK; row <= (block_row + 1) * BLOCK; ++row)
        for (int column = block_column * BLOCK; column <= (block_column + 1) * BLOCK; ++column)
          top = std::max(top, sample(column, row));
      tops_.push_back(top);
    }
}

HeightMap::Block HeightMap::blockAt(double x, double y) const {
  const auto rangeOf = [this](double coordinate, double origin, int samples, int blocks,
                              double& low, double& high) {
    const int block = placeAt(coordinate, origin, law_.resolution, samples).index / BLOCK;
    low = block == 0 ? -ENDLESS : origin + law_.resolution * (block * BLOCK);
    high = block == blocks - 1 ? ENDLESS : origin + law_.resolution * ((block + 1) * BLOCK);
    return block;
  };
  Block out{};
  const int column =
      rangeOf(x, law_.origin.x(), image_.columns, block_columns_, out.min_x, out.max_x);
  const int row = rangeOf(y, law_.origin.y(), image_.rows, block_rows_, out.min_y, out.max_y);
  out.top = tops_[static_cast<std::size_t>(row) * block_columns_ + column];
  return out;
}

HeightMap HeightMap::load(const std::string& file) {
  if (file.empty()) return {};
  Faults faults;
  YamlSection yaml(loadYamlFile(file), file, faults);
  HeightMapLaw law;
  describe(yaml, law);
  std::string image;
  yaml.text("image", image);
  if (image.empty()) yaml.fault("image", "is missing: the path of a PNG or PGM file");
  for (const char* key : {"resolution", "height_max"})
    if (!yaml.has(key)) yaml.fault(key, "is missing");
  checkHeights(law, file, faults);
  yaml.finish();
  faults.throwIfAny();
  return HeightMap(law,
                   loadGreyImage((std::filesystem::path(file).parent_path() / image).string()));
}

double HeightMap::height(double x, double y) const {
  if (isFlat()) return 0.0;
  const Cell c = cellAt(x, y);
  const double south = c.h00 * (1.0 - c.u) + c.h10 * c.u;
  const double north = c.h01 * (1.0 - c.u) + c.h11 * c.u;
  return south * (1.0 - c.v) + north * c.v;
}

Vec3 HeightMap::normal(double x, double y) const {
  if (isFlat()) return Vec3::UnitZ();
  const Cell c = cellAt(x, y);
  const double rise_x = (c.h10 - c.h00) * (1.0 - c.v) + (c.h11 - c.h01) * c.v;
  const double rise_y = (c.h01 - c.h00) * (1.0 - c.u) + (c.h11 - c.h10) * c.u;
  const double slope_x = c.inside_x ? rise_x / law_.resolution : 0.0;
  const double slope_y = c.inside_y ? rise_y / law_.resolution : 0.0;
  const double scale = 1.0 / std::sqrt(slope_x * slope_x + slope_y * slope_y + 1.0);
  return {-slope_x * scale, -slope_y * scale, scale};
}

}  // namespace vegetation_sim::terrain
