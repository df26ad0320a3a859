// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/crowd/paper_decision.h"

#include <algorithm>

namespace vegetation_sim::crowd {
namespace {

constexpr double LARGEST_TURN = 1.4;                     // at contact [rad]
constexpr std::uint64_t KEY_OF_SPEED = 0x5350454544ULL;  // makes its noise another one

}  // namespace

Command decideByPaper(const Walker& walker, const View& view, const CrowdSettings& s,
                      const Wish& wish, Nanoseconds stamp) {
  Command out{wish.direction, wish.speed};
  double distance = s.sensor_range, turn = 0.0;
  if (view.count > 0) {
    const Sight& nearest = view.at(0);
    distance = std::min(distance, std::max(0.0, nearest.gap));
    const double near = 1.0 - distance / s.sensor_range;
    const double left = wish.direction.x * nearest.normal.y - wish.direction.y * nearest.normal.x;
    turn = (left < 0.0 ? 1.0 : -1.0) * LARGEST_TURN * near;
    out.speed *= std::max(s.slowest, 1.0 - near);
  }
  const auto draw = static_cast<std::uint64_t>(stamp);
  turn += noiseAt(s, s.noise_heading, distance) * normalNumber(walker.key, draw);
  if (s.noise_speed > 0.0)
    out.speed = noisySpeed(out.speed, noiseAt(s, s.noise_speed, distance) *
                                          normalNumber(walker.key ^ KEY_OF_SPEED, draw));
  out.direction = turned(wish.direction, sinCos(turn));
  return out;
}

}  // namespace vegetation_sim::crowd
