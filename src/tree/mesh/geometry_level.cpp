// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/mesh/geometry_level.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vegetation_sim::forest {
namespace {

struct Step {
  double smallest_px;  // height of a tree from which this level is drawn
  MeshDetail detail;
};

constexpr std::array<Step, GEOMETRY_LEVELS> STEPS{{{0.0, {1, 3, 1, 0.016, 3.4, true}},
                                                   {30.0, {1, 3, 2, 0.045, 2.4, true}},
                                                   {70.0, {2, 4, 1, 0.11, 1.8, true}},
                                                   {140.0, {2, 6, 3, 0.24, 1.45, true}},
                                                   {280.0, {3, 8, 4, 0.52, 1.2, true}},
                                                   {560.0, {MAX_DEPTHS, 11, 16, 1.0, 1.0, false}}}};
constexpr double BORDER = 0.15;  // hysteresis, fraction of the size
constexpr double DEAD_BAND = 0.05;
constexpr double LEAST_EXPONENT = 0.1;  // overshot three times
constexpr double MOST_ERROR = 0.7;      // logarithm; maximum error used in a step
constexpr double LEAST_FACTOR = 1.0 / 64.0, LARGEST_FACTOR = 64.0;

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
  actual = std::max(actual, 1.0);
  const bool same = target == target_ && std::fabs(actual - rests_at_) <= DEAD_BAND * target;
  target_ = target;
  if (rests_at_ > 0.0 && same) return;
  const bool met = std::fabs(target / actual - 1.0) < DEAD_BAND;
  if (met || rests_at_ > 0.0) *this = ComplexityFeedback(factor_, target_);
  if (met) return;
  const double error = std::log(target / actual);
  const bool overshot = error * error_ < 0.0;
  if (overshot) exponent_ *= 0.5;
  if (overshot && exponent_ < LEAST_EXPONENT && std::fabs(error) <= std::fabs(error_))
    rests_at_ = actual;
  else
    factor_ = std::clamp(factor_ * std::exp(exponent_ * std::clamp(error, -MOST_ERROR, MOST_ERROR)),
                         LEAST_FACTOR, LARGEST_FACTOR);
  error_ = error;
}

}  // namespace vegetation_sim::forest
