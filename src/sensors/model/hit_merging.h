// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sensors/geometry/ray.h"

namespace vegetation_sim::scan {

/// Light that comes back to the sensor from one distance.
struct Echo {
  double distance{0.0};  ///< [m]
  /// Reflectance times cosine of incidence, summed over the rays of the beam and divided by their
  /// number.
  double signal{0.0};
  Hit hit;  ///< of the ray with the strongest signal
};

/// Returns the approximate share of light at 905 nm that an object reflects.
double reflectanceOf(Label label);
/// Returns the reflectance times the cosine of incidence.
double signalOf(const Hit& hit);

/// Sorts the hits of the rays of one beam, all of them with those that hit nothing, by distance and
/// joins neighbours of at most `separation` to an echo. The distance of an echo is the mean of its
/// hits, weighted by signal.
void joinHits(std::vector<Hit>& hits, double separation, std::vector<Echo>& out);

}  // namespace vegetation_sim::scan
