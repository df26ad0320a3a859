// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "grass/lod/node_wind.h"

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/wind/sampling/wind_samples.h"
#include "wind/laws.h"

namespace vegetation_sim::grass {
namespace {

int bounded(double x) {
  return static_cast<int>(std::min(1e9, std::max(-1e9, x)));
}

}  // namespace

std::size_t NodeWind::indexOf(int column, int row) const {
  return static_cast<std::size_t>(row - window_.first_row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column - window_.first_column);
}

Vec3 NodeWind::placeOf(int column, int row) const {
  const MapLaw& law = map_.law();
  const double x = law.origin_x + law.resolution * column;
  const double y = law.origin_y + law.resolution * row;
  return {x, y, terrain_.height(x, y)};
}

// Returns the nodes of the window within a box, both ends included.
NodeWind::Span NodeWind::spanOf(double min_x, double max_x, double min_y, double max_y) const {
  const MapLaw& law = map_.law();
  const auto first = [&](double x, double origin) {
    return bounded(std::ceil((x - origin) / law.resolution));
  };
  const auto last = [&](double x, double origin) {
    return bounded(std::floor((x - origin) / law.resolution));
  };
  return {std::max(first(min_x, law.origin_x), window_.first_column),
          std::min(last(max_x, law.origin_x), window_.last_column + 1),
          std::max(first(min_y, law.origin_y), window_.first_row),
          std::min(last(max_y, law.origin_y), window_.last_row + 1)};
}

// Returns the nodes that a primitive can move. The box is slightly larger, so that rounding omits
// no node.
NodeWind::Span NodeWind::maskOf(const wind::Term& term) const {
  constexpr double HAIR = 1e-6;
  const double x = term.centre.x(), y = term.centre.y(), r = term.radius + HAIR;
  if (!wind::hasStrip(term.kind)) return spanOf(x - r, x + r, y - r, y + r);
  const wind::Strip strip = stripOf(term);
  const double ahead = strip.ahead + HAIR, behind = strip.behind + HAIR, side = strip.side + HAIR;
  const double nx = term.direction.x(), ny = term.direction.y();
  const double side_x = side * std::fabs(ny) + HAIR, side_y = side * std::fabs(nx) + HAIR;
  return spanOf(x + std::min(ahead * nx, -behind * nx) - side_x,
                x + std::max(ahead * nx, -behind * nx) + side_x,
                y + std::min(ahead * ny, -behind * ny) - side_y,
                y + std::max(ahead * ny, -behind * ny) + side_y);
}

void NodeWind::want(const std::vector<TilePlace>* tiles) {
  wanted_.assign(air_.size(), tiles ? 0 : 1);
  if (!tiles) return;
  for (const TilePlace& tile : *tiles)
    for (int corner = 0; corner < 4; ++corner)
      wanted_[indexOf(tile.column + corner % 2, tile.row + corner / 2)] = 1;
}

// Adds the breeze at all wanted nodes, vectorised.
void NodeWind::blow(const wind::Instant& wind) {
  asked_.clear();
  for (std::size_t i = 0; i < air_.size(); ++i)
    if (wanted_[i]) asked_.push_back(i);
  constexpr std::size_t ROOM = wind::WindSamples::ROOM;
  const std::size_t count = asked_.size(), pitch = (count + ROOM - 1) / ROOM * ROOM;
  rows_.resize(6 * pitch);
  double* const r = rows_.data();
  const auto columns = static_cast<std::size_t>(columns_);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 place = placeOf(window_.first_column + static_cast<int>(asked_[k] % columns),
                               window_.first_row + static_cast<int>(asked_[k] / columns));
    for (std::size_t axis = 0; axis < 3; ++axis)
      r[axis * pitch + k] = place[static_cast<int>(axis)];
  }
  sampleBreeze(wind,
               {r, r + pitch, r + 2 * pitch, r + 3 * pitch, r + 4 * pitch, r + 5 * pitch, count});
  for (std::size_t k = 0; k < count; ++k)
    air_[asked_[k]] = Vec3(r[3 * pitch + k], r[4 * pitch + k], r[5 * pitch + k]);
}

void NodeWind::update(const wind::Instant& wind, const std::vector<ColourMask>& masks,
                      const TileWindow& window, const std::vector<TilePlace>* tiles) {
  window_ = window;
  columns_ = std::max(0, window.last_column - window.first_column + 2);
  const int rows = std::max(0, window.last_row - window.first_row + 2);
  if (window.last_column < window.first_column || window.last_row < window.first_row) columns_ = 0;
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows);
  touched_ = 0;
  air_.assign(count, wind.mean);
  tints_.assign(count, Tint());
  if (count == 0) return;
  want(tiles);
  if (!wind.modes.empty()) blow(wind);
  const auto for_nodes = [&](const Span& span, auto&& visit) {
    for (int row = span.first_row; row <= span.last_row; ++row)
      for (int column = span.first_column; column <= span.last_column; ++column)
        if (const std::size_t i = indexOf(column, row);
            wanted_[i] && visit(i, placeOf(column, row)))
          ++touched_;
  };
  for (const wind::Term& term : wind.terms)
    for_nodes(maskOf(term), [&](std::size_t i, const Vec3& place) {
      const Vec3 air = velocityOf(term, place);
      air_[i] += air;
      return !air.isZero(0.0);
    });
  for (const ColourMask& mask : masks) {
    const double r = mask.radius;
    const Point& c = mask.centre;
    for_nodes(spanOf(c.x - r, c.x + r, c.y - r, c.y + r), [&](std::size_t i, const Vec3& place) {
      const double weight = weightAt(mask, place.x(), place.y());
      tints_[i].weight += weight;
      tints_[i].sum += weight * mask.colour;
      return weight > 0.0;
    });
  }
}

double NodeWind::colourAt(int column, int row) const {
  const Tint& tint = tints_[indexOf(column, row)];
  return (map_.node(column, row).colour + tint.sum) / (1.0 + tint.weight);
}

void NodeWind::fill(Tile& tile, TileMotion& motion) const {
  for (int corner = 0; corner < 4; ++corner) {
    const auto k = static_cast<std::size_t>(corner);
    const int column = tile.column + corner % 2, row = tile.row + corner / 2;
    const Vec3 air = at(column, row);
    motion.wind_x[k] = static_cast<float>(air.x());
    motion.wind_y[k] = static_cast<float>(air.y());
    tile.colour[k] = static_cast<float>(colourAt(column, row));
  }
}

Point bendIn(const Vec3& air, double compliance) {
  const double x = compliance * air.x(), y = compliance * air.y();
  const double size = std::sqrt(x * x + y * y);
  if (!(size > BEND_KNEE)) return {x, y};
  const double factor = softLimit(size, BEND_KNEE, BEND_LIMIT) / size;
  return {x * factor, y * factor};
}

}  // namespace vegetation_sim::grass
