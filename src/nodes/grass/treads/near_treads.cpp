// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/grass/treads/near_treads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vegetation_sim {
namespace {

constexpr double LONGEST_REACH = 10.0;  // of a TreadLaw [m]
constexpr double SHORT_STROKE = 10.0;   // which passes no tile if both ends are far [m]

// Sets what is within `reach` of a set value in the same line.
// @param step from one line to the next. @param stride from one value of a line to the next.
void widen(char* values, int lines, int count, int step, int stride, int reach) {
  std::vector<char> line(static_cast<std::size_t>(count));
  for (int i = 0; i < lines; ++i) {
    char* const first = values + std::ptrdiff_t{i} * step;
    for (int k = 0; k < count; ++k)
      line[static_cast<std::size_t>(k)] = first[std::ptrdiff_t{k} * stride];
    int until = -1;  // set up to here, because of values before
    for (int k = 0; k < count; ++k) {
      if (line[static_cast<std::size_t>(k)]) until = k + reach;
      if (k <= until) first[std::ptrdiff_t{k} * stride] = 1;
    }
    until = count;
    for (int k = count - 1; k >= 0; --k) {
      if (line[static_cast<std::size_t>(k)]) until = k - reach;
      if (k >= until) first[std::ptrdiff_t{k} * stride] = 1;
    }
  }
}

}  // namespace

double NearTreads::marginOf(double longest_stroke, double block) {
  return 2.0 * longest_stroke + LONGEST_REACH + SHORT_STROKE + block;
}

NearTreads::NearTreads(const grass::MapLaw& law, const grass::TileOwners& owners, double margin)
    : law_(law) {
  if (owners.shard().count == 1) return;
  const int columns = law.columns - 1, rows = law.rows - 1;
  const int reach = 1 + static_cast<int>(std::min(1e6, margin / law.resolution));
  is_near_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      if (owners.ownerOf(column, row) == owners.shard().index)
        is_near_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)] = 1;
  widen(is_near_.data(), rows, columns, columns, 1, reach);
  widen(is_near_.data(), columns, rows, 1, columns, reach);
}

// A place beyond the map is as near as the nearest tile; one that is not finite is not far.
bool NearTreads::isFar(const geometry_msgs::Point& place) const {
  const double column = std::floor((place.x - law_.origin_x) / law_.resolution);
  const double row = std::floor((place.y - law_.origin_y) / law_.resolution);
  if (!std::isfinite(column) || !std::isfinite(row)) return false;
  const auto tile = [](double at, int count) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, count - 1.0));
  };
  return is_near_[tile(row, law_.rows - 1) * static_cast<std::size_t>(law_.columns - 1) +
                  tile(column, law_.columns - 1)] == 0;
}

bool NearTreads::isFar(const TreadEvent& event) const {
  if (event.action == TreadEvent::LIFT) return true;
  if (event.action > TreadEvent::STROKE || !isFar(event.position)) return false;
  if (event.action != TreadEvent::STROKE) return true;
  // A long stroke may pass by.
  const double x = event.position.x - event.start.x, y = event.position.y - event.start.y;
  return x * x + y * y <= SHORT_STROKE * SHORT_STROKE && isFar(event.start);
}

NearTreads::Use NearTreads::useOf(const TreadEvent& event, bool is_known) {
  if (is_near_.empty()) return Use::ALL;
  if (!isFar(event)) return Use::ALL;
  return near_.erase(event.source) > 0 || is_known || is_full_ ? Use::LIFT : Use::NONE;
}

void NearTreads::keep(const TreadEvent& event) {
  if (is_near_.empty()) return;
  is_full_ |= near_.size() >= MOST_NAMES;
  if (!is_full_) near_.insert(event.source);
}

}  // namespace vegetation_sim
