// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/forest/geometry_level.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

struct Step {
  double smallest_px;  // height of a tree from which this level is drawn
  MeshDetail detail;
};

constexpr std::array<Step, GEOMETRY_LEVELS> STEPS{{{0.0, {1, 3, 0.03}},
                                                   {40.0, {2, 3, 0.07}},
                                                   {90.0, {2, 4, 0.15}},
                                                   {180.0, {3, 5, 0.3}},
                                                   {360.0, {4, 7, 0.6}},
                                                   {720.0, {MAX_DEPTHS, 10, 1.0}}}};
constexpr double BORDER = 0.15;  // hysteresis, fraction of the size
constexpr double DEAD_BAND = 0.05;

}  // namespace

MeshDetail meshDetail(int geometry_level) {
  return STEPS[static_cast<std::size_t>(std::clamp(geometry_level, 0, GEOMETRY_LEVELS - 1))].detail;
}

int geometryLevel(double height_px, int current) {
  int level = 0;
  while (level + 1 < GEOMETRY_LEVELS &&
         height_px >= STEPS[static_cast<std::size_t>(level) + 1].smallest_px)
    ++level;
  if (current < 0 || current == level) return level;
  const double border = STEPS[static_cast<std::size_t>(std::max(current, level))].smallest_px;
  const bool near_border = std::fabs(height_px - border) < BORDER * border;
  return std::abs(current - level) == 1 && near_border ? current : level;
}

void ComplexityFeedback::update(double actual, double target) {
  const double ratio = target / std::max(actual, 1.0);
  if (std::fabs(ratio - 1.0) < DEAD_BAND) return;
  const double step = std::clamp(std::sqrt(ratio), 0.8, 1.25);
  factor_ = std::clamp(factor_ * step, 1.0 / 64.0, 64.0);
}

}  // namespace vegetation_sim::forest
