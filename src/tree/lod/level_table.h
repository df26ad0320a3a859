// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>

#include "tree/lod/response_error.h"
#include "vegetation_sim/tree/motion/motion_level.h"

namespace vegetation_sim::forest {

/// Error of each level, measured on sample trees of a species and scale in uniform wind from
/// several directions: the largest displacement of any tip per wind speed if only depths below n
/// move [m per m/s]. Index n; decreases to 0.
struct LevelTable {
  std::array<double, MAX_DEPTHS + 1> omitted{};
  std::array<double, MAX_DEPTHS + 1> branches{};  ///< of depths below n, mean of the samples
  double height{1.0}, reach{1.0};                 ///< largest of the samples [m]
};
LevelTable measureLevels(const Species& species, const MotionLaw& law, double scale);

/// Level tables of one species over scales: leaves and twigs do not grow in proportion, so the
/// motion does not either. Interpolated between measured scales.
class LevelScales {
 public:
  /// Measures what at(scale) needs.
  void measure(const Species& species, const MotionLaw& law, double scale);
  LevelTable at(double scale) const;
  /// Returns the response error in a wind at a measured scale. The first call for a scale takes
  /// some 150 ms.
  PredictedError responseErrorAt(const Species& species, const MotionLaw& law, double scale,
                                 const wind::GustSpectrum& spectrum);

 private:
  std::map<std::size_t, ResponseError> response_errors_;
  std::map<std::size_t, LevelTable> tables_;  // by index into the grid of scales
};

/// Returns the smallest level whose predicted error [pixel] is within the tolerance (S1-22, S1-40):
/// 0 without wind or out of sight. `current` is kept while the error at the next lower level is
/// above HYSTERESIS * tolerance, so that levels do not flicker.
int chooseLevel(const LevelTable& table, double speed, double pixels_per_metre, double tolerance,
                int current);

}  // namespace vegetation_sim::forest
