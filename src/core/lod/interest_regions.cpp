// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/lod/interest_regions.h"

#include <algorithm>

namespace vegetation_sim {
namespace {

bool contains(const InterestArea& outer, const InterestArea& inner) {
  const double x = inner.x - outer.x, y = inner.y - outer.y, room = outer.radius - inner.radius;
  return room >= 0.0 && x * x + y * y <= room * room;
}

}  // namespace

bool operator==(const InterestArea& a, const InterestArea& b) {
  return a.x == b.x && a.y == b.y && a.radius == b.radius;
}

bool covers(const std::vector<InterestArea>& discs, const InterestArea& inner) {
  return std::any_of(discs.begin(), discs.end(),
                     [&](const InterestArea& disc) { return contains(disc, inner); });
}

bool InterestRegions::update(const std::vector<InterestArea>& wanted) {
  std::vector<InterestArea> next;
  bool is_new = false;
  for (const InterestArea& want : wanted) {
    if (covers(next, want)) continue;
    const auto held = std::find_if(discs_.begin(), discs_.end(), [&](const InterestArea& disc) {
      return contains(disc, want) && disc.radius <= want.radius + MARGIN;
    });
    is_new = is_new || held == discs_.end();
    next.push_back(held != discs_.end() ? *held
                                        : InterestArea{want.x, want.y, want.radius + MARGIN});
  }
  const bool is_whole = next.empty() && !discs_.empty();
  discs_ = std::move(next);
  return is_new || is_whole;
}

bool InterestRegions::includes(double x, double y, double side) const {
  return discs_.empty() || std::any_of(discs_.begin(), discs_.end(), [&](const InterestArea& disc) {
           const double dx = disc.x - std::clamp(disc.x, x, x + side);
           const double dy = disc.y - std::clamp(disc.y, y, y + side);
           return dx * dx + dy * dy <= disc.radius * disc.radius;
         });
}

}  // namespace vegetation_sim
