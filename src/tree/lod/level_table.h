// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>

#include "tree/lod/response_error.h"
#include "vegetation_sim/tree/motion/motion_level.h"

namespace vegetation_sim::forest {

/// What a level leaves out, measured on sample trees of a species and scale in uniform wind from
/// several sides: the largest displacement of any tip per wind speed if only depths below n move
/// [m per m/s]. Index n; falls to 0.
struct LevelTable {
  std::array<double, MAX_DEPTHS + 1> omitted{};
  std::array<double, MAX_DEPTHS + 1> branches{};  ///< of depth below n, mean of the samples
  double height{1.0}, reach{1.0};                 ///< largest of the samples [m]
};
LevelTable measureLevels(const Species& species, const MotionLaw& law, double scale);

/// Level tables of one species over the scales that its trees have: leaves and twigs do not grow in
/// proportion, so neither does the motion. Between measured scales, interpolated.
class LevelScales {
 public:
  /// Makes at(scale) known.
  void measure(const Species& species, const MotionLaw& law, double scale);
  LevelTable at(double scale) const;
  /// ResponseError (lag.h) in a wind at a known scale; measured when it is first asked for, some
  /// 150 ms.
  PredictedError responseErrorAt(const Species& species, const MotionLaw& law, double scale,
                                 const wind::GustSpectrum& spectrum);

 private:
  std::map<std::size_t, ResponseError> response_errors_;
  std::map<std::size_t, LevelTable> tables_;  // by index into the grid of scales
};

/// Smallest level whose predicted error [pixel] holds the tolerance (S1-22, S1-40): 0 without wind
/// or out of sight. `current` is kept while the error at the next lower level is above
/// HYSTERESIS * tolerance, so that a level at its border does not flicker.
int chooseLevel(const LevelTable& table, double speed, double pixels_per_metre, double tolerance,
                int current);

}  // namespace vegetation_sim::forest
