// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/layers/plane_view.h"

namespace vegetation_sim::canopy {

/// Equations 1 and 2 of paper 3 as printed, from the plane's tilt and the angles between plane and
/// view in XZ (alpha) and YZ (beta) [rad]. Shortens the vector at any angle but 0 (E8).
Vec3 printedToView(const PlaneVector& in_plane, double tilt, double alpha, double beta);

/// The angles that printedToView() takes [rad].
struct PrintedAngles {
  double tilt, alpha, beta;
};
PrintedAngles printedAngles(const Axes& plane, const Axes& view);

}  // namespace vegetation_sim::canopy
