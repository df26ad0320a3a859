// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/grass/grass_bounds.h"

#include <cmath>

#include "sensors/grass/blade_width.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

constexpr double FLATTEST = 0.0707;      // height over length of a blade that leans BEND_LIMIT
constexpr double ROUNDING = 1.0 + 1e-6;  // more than the rounding of all that is computed here

// Corners of a tile and what is largest among them.
struct Corners {
  Corners(const grass::FeatureMap& map, int column, int row) {
    for (int i = 0; i < 4; ++i) {
      nodes[i] = map.node(column + i % 2, row + i / 2);
      height = std::max(height, nodes[i].height);
      density = std::max(density, nodes[i].density);
      shape = std::max(shape, nodes[i].shape);
    }
  }
  grass::Features nodes[4];
  double height{0.0}, density{0.0}, shape{0.0};
};

// Returns by how much blades are denser for a ray that bend to the share `rise` of their length in
// height, or higher, than upright ones: sqrt(1 - r^2 s - (1 - r^2) (1 - s) / 2) / r at the squared
// cosine s of the ray. Its square is linear in s, so that an end of s is the worst, and falls with
// r.
double factorFrom(double rise) {
  const double per_square = 1.0 / (rise * rise);
  return ROUNDING * std::sqrt(std::max(0.5 * per_square + 0.5, per_square - 1.0));
}

// Returns the bound for upright blades from a height on. The mean over species with interpolated
// shares is at most the largest mean of a corner.
double boundFrom(double height, const Corners& corners, const grass::FeatureMap& map) {
  double largest = 0.0;
  for (const grass::Features& node : corners.nodes) {
    double sum = 0.0, shares = 0.0;
    for (std::size_t k = 0; k < map.species().size(); ++k) {
      const grass::Species& kind = map.species()[k].species;
      const double most = corners.height * kind.height;
      sum += node.mix[k] * kind.width * widthAt(height, most * (1.0 - kind.height_spread), most);
      shares += node.mix[k];
    }
    if (shares > 0.0) largest = std::max(largest, sum / shares);
  }
  return ROUNDING * corners.density * largest;
}

}  // namespace

void GrassBounds::setMap(const grass::FeatureMap& map) {
  const grass::MapLaw& law = map.law();
  origin_x_ = law.origin_x;
  origin_y_ = law.origin_y;
  tile_ = law.resolution;
  columns_ = map.tileColumns();
  rows_ = map.tileRows();
  per_band_ = map.tallest() > 0.0 ? BANDS / map.tallest() : 0.0;
  kinds_.clear();
  double tallest = 0.0;  // of the species
  for (const grass::SpeciesInput& input : map.species()) {
    kinds_.push_back({input.species.lean, input.species.compliance});
    tallest = std::max(tallest, input.species.height);
  }
  still_.clear();
  trodden_bound_.clear();
  shape_.clear();
  still_bent_.clear();
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const Corners corners(map, column, row);
      const double longest = corners.height * tallest;
      for (int band = 0; band < BANDS; ++band) {
        const double height = map.tallest() * band / BANDS * (2.0 - ROUNDING);
        const double bound = boundFrom(height, corners, map);
        // Blades that reach this height do not lean more.
        const double rise = std::max(FLATTEST, longest > 0.0 ? height / longest : 1.0);
        still_.push_back(static_cast<float>(bound));
        trodden_bound_.push_back(static_cast<float>(bound * factorFrom(std::min(rise, 1.0))));
      }
      shape_.push_back(static_cast<float>(ROUNDING * corners.shape));
      still_bent_.push_back(static_cast<float>(bentBy(0.0, double{shape_.back()})));
    }
}

double GrassBounds::bentBy(double wind, double shape) const {
  double largest = 0.0;
  for (const Kind& kind : kinds_) {
    const double blown = softLimit(kind.compliance * wind, grass::BEND_KNEE, grass::BEND_LIMIT);
    const double lean = kind.lean * shape;
    const double bend = softLimit(std::sqrt(blown * blown + lean * lean / 3.0), grass::BEND_KNEE,
                                  grass::BEND_LIMIT);
    const double rise = 1.0 - 0.125 * bend * bend;  // at most cos(bend / 2)
    largest = std::max(largest, factorFrom(rise));
  }
  return largest;
}

void GrassBounds::setWind(const grass::NodeWind* air, const grass::TileWindow& window) {
  bent_ = still_bent_;
  if (!air) return;
  for (int row = window.first_row; row <= std::min(window.last_row, rows_ - 1); ++row)
    for (int column = window.first_column; column <= std::min(window.last_column, columns_ - 1);
         ++column) {
      double wind = 0.0;
      for (int i = 0; i < 4; ++i) {
        const Vec3 at = air->at(column + i % 2, row + i / 2);
        wind = std::max(wind, at.x() * at.x() + at.y() * at.y());
      }
      const auto tile = static_cast<std::size_t>(row * columns_ + column);
      bent_[tile] = static_cast<float>(bentBy(ROUNDING * std::sqrt(wind), double{shape_[tile]}));
    }
}

void GrassBounds::setTread(const grass::TreadMap& tread) {
  spacing_ = tread.spacing();
  const double cells = std::round(tile_ / spacing_);  // of a tile's side
  constexpr int SIDE = grass::TreadBlock::SIDE;
  block_columns_ = static_cast<int>(columns_ * cells) / SIDE + 1;
  block_rows_ = static_cast<int>(rows_ * cells) / SIDE + 1;
  trodden_.assign(static_cast<std::size_t>(rows_ * columns_), 0);
  trodden_blocks_.assign(static_cast<std::size_t>(block_rows_ * block_columns_), 0);
  const auto tileOf = [&](int node, double half, int tiles) {
    return std::clamp(static_cast<int>(std::floor((node + half) / cells)), 0, tiles - 1);
  };
  for (const auto& entry : tread.state().blocks) {
    const auto [block_row, block_column] = entry.first;
    if (block_row >= block_rows_ || block_column >= block_columns_) continue;
    trodden_blocks_[static_cast<std::size_t>(block_row * block_columns_ + block_column)] = 1;
    const int row = block_row * SIDE, column = block_column * SIDE;  // of the first node
    for (int r = tileOf(row, -0.6, rows_); r <= tileOf(row + SIDE - 1, 0.6, rows_); ++r)
      for (int c = tileOf(column, -0.6, columns_); c <= tileOf(column + SIDE - 1, 0.6, columns_);
           ++c)
        trodden_[static_cast<std::size_t>(r * columns_ + c)] = 1;
  }
}

// Rounds to a node like TreadMap::at(), so that a place is in the same block in both.
bool GrassBounds::isTrodden(double x, double y) const {
  const auto blockOf = [this](double at, double origin, int blocks) {
    const double node = std::floor((at - origin) / spacing_ + 0.5);
    return static_cast<int>(std::clamp(node / grass::TreadBlock::SIDE, 0.0, blocks - 1.0));
  };
  const int row = blockOf(y, origin_y_, block_rows_);
  const int column = blockOf(x, origin_x_, block_columns_);
  return trodden_blocks_[static_cast<std::size_t>(row * block_columns_ + column)] != 0;
}

}  // namespace vegetation_sim::scan
