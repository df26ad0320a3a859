// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/tree/growth/forest_layout.h"
#include "wind/sampling/gust_spectrum.h"

namespace vegetation_sim::forest {

/// Squares of the farthest tip's distance from the full chain, per square of the speed [s^2].
struct ErrorSquares {
  double procedural{0.0}, modal{0.0}, fine{0.0};
};

/// How far tiers are off in a steady wind, whose loads change as the tree bends, per square of the
/// bending speed [s^2/m]. The procedural motion knows nothing of it, modes the first order, of
/// which plain ones span a part.
struct Bending {
  double procedural{0.0}, modal{0.0};
};

/// How far tiers are off in one wind.
struct PredictedError {
  double procedural{0.0};  ///< farthest tip [m]
  double modal{0.0};       ///< of a tree in modes [m]
  double fine{0.0};        ///< in fine ones [m]
  Bending bend;            ///< of each in a steady wind
};

/// How far the tiers of a species are off where wind comes and goes: the procedural one answers it
/// at once and asks for it at each branch alone; modes are few; levers change as a tree bends. From
/// sample trees beside the full chain, in closed form: waves of small motion. 0 where joints do not
/// bend.
struct ResponseError {
  std::array<std::array<ErrorSquares, wind::GustSpectrum::FREQUENCIES.size()>,
             wind::GustSpectrum::SLOWNESSES.size()>
      squares{};  ///< at the points of wind::GustSpectrum
  Bending bend;   ///< 0 for a gain that is another from the first metre on

  PredictedError in(const wind::GustSpectrum& spectrum) const;
};
ResponseError measureResponseError(const Species& species, const MotionLaw& law, double scale);

}  // namespace vegetation_sim::forest
