// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/tree/growth/forest_layout.h"
#include "wind/sampling/gust_spectrum.h"

namespace vegetation_sim::forest {

/// Squares of the distance of the farthest tip from the full chain, per square of the speed [s^2].
struct ErrorSquares {
  double procedural{0.0}, modal{0.0}, fine{0.0};
};

/// Errors of tiers in steady wind, by loads that change as the tree bends, per square of the
/// bending speed [s^2/m]. The procedural motion omits the change; modes have the first order, of
/// which plain modes span a part.
struct Bending {
  double procedural{0.0}, modal{0.0};
};

/// Errors of tiers in one wind.
struct PredictedError {
  double procedural{0.0};  ///< farthest tip [m]
  double modal{0.0};       ///< of plain modes [m]
  double fine{0.0};        ///< of fine modes [m]
  Bending bend;            ///< in steady wind
};

/// Errors of the tiers of a species in gusts: the procedural tier responds immediately and to the
/// wind at each branch alone; modes are few; lever arms change as a tree bends. Computed on sample
/// trees against the full chain, in closed form for waves of small motion. 0 where joints do not
/// bend.
struct ResponseError {
  std::array<std::array<ErrorSquares, wind::GustSpectrum::FREQUENCIES.size()>,
             wind::GustSpectrum::SLOWNESSES.size()>
      squares{};  ///< at the sample points of wind::GustSpectrum
  Bending bend;   ///< 0 for the gain as printed

  PredictedError in(const wind::GustSpectrum& spectrum) const;
};
ResponseError measureResponseError(const Species& species, const MotionLaw& law, double scale);

}  // namespace vegetation_sim::forest
