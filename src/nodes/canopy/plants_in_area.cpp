// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/plants_in_area.h"

#include <algorithm>

#include "grass/tread/area_rows.h"

namespace vegetation_sim {
namespace {

constexpr std::size_t MOST_WORK = 20'000'000;  // corners times plants

bool isInside(const Vec3& foot, const grass::CutArea& area) {
  const auto ranges = rangesAt(foot.y(), area.outline, area.radius);
  return std::any_of(ranges.begin(), ranges.end(), [&](const auto& range) {
    return range.first <= foot.x() && foot.x() <= range.second;
  });
}

}  // namespace

std::vector<std::uint32_t> plantsIn(const std::vector<canopy::Plant>& plants,
                                    const grass::CutArea& area) {
  const grass::AreaBounds bounds = boundsOf(area.outline, area.radius);
  std::vector<std::uint32_t> out;
  for (std::uint32_t id = 0; id < plants.size(); ++id) {
    const Vec3& foot = plants[id].position;
    if (foot.x() >= bounds.low.x && foot.x() <= bounds.high.x && foot.y() >= bounds.low.y &&
        foot.y() <= bounds.high.y)
      out.push_back(id);
  }
  const std::size_t work = out.size() * area.outline.size();
  if (work > MOST_WORK)
    throw InvalidInput("outline has " + std::to_string(area.outline.size()) + " points around " +
                           std::to_string(out.size()) + " plants, their product may be " +
                           std::to_string(MOST_WORK) + " at most",
                       FaultCode::NO_ROOM);
  out.erase(std::remove_if(out.begin(), out.end(),
                           [&](std::uint32_t id) { return !isInside(plants[id].position, area); }),
            out.end());
  return out;
}

}  // namespace vegetation_sim
