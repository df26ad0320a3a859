// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/layers/layer_delay.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// WARP moves the points of a grid. BEND turns leaves about their feet, so that no point leaves its
/// foot (S3-W4).
enum class WarpMethod { WARP, BEND };

/// Displacement of leaves by the motion (paper 3, equations 6 and 7).
struct WarpSettings {
  Formula form{Formula::DERIVED};  ///< form of depthShare() and of the displacement (E10)
  /// Scale across, up, and of the shrinking that represents motion in depth (S3-25, S3-26).
  Vec3 lambda{Vec3(1.0, 1.0, 0.5)};
  double reference_time{0.05};  ///< displacement per velocity [s]
  double depth_loss{0.3};       ///< m: share that the last layer moves less
  double rigidity{1.5};         ///< r of equation 7; 0: every part moves equally
  WarpMethod method{WarpMethod::WARP};
  /// Tangent of a leaf's rotation about its midrib per relative displacement of its tip across its
  /// face (S3-W3).
  double twist{0.3};
};
void describe(FieldVisitor& visitor, WarpSettings& settings);

/// Returns R of equation 7: (height / top)^rigidity, from 0 at the root to 1 at the top. For a
/// rigidity of 0 it is 1 everywhere; else a plant without height does not move.
double mobility(double height, double top, double rigidity);

/// Returns the visible share of a layer's motion: 1 - m ratio^2 as derived, (1 - ratio^2) m as
/// printed. The ratio is 0 for a single layer and without depth.
double depthShare(const WarpSettings& settings, double distance, double last);

/// Returns the displacement [m] to the right, up and 0 of a leaf whose layer moves by `velocity`
/// [m/s] in the view's axes. As printed it is proportional to the step `dt`; as derived it does not
/// depend on it.
Vec3 displacement(const WarpSettings& settings, const Vec3& velocity, double share, double dt);

/// Returns the displacement that keeps the length of `arm`, from foot to point: a bend, not a
/// shear.
Vec3 bent(const Vec3& arm, const Vec3& displacement);

/// Returns `side`, which is perpendicular to the midrib `along`, rotated about it by the
/// displacement of the tip across the leaf's face; by less than a quarter turn.
Vec3 twisted(const WarpSettings& settings, const Vec3& along, const Vec3& side,
             const Vec3& displacement);

/// Weakens the difference from the layer's mean until no two points change places, however the
/// motion is turned into the view: with gradients of at most a half the map has an inverse. @param
/// reach displacement per velocity, the largest of all axes [s]. @return the weakening, 0 to 1.
double limitFolding(LayerMotion& motion, double reach, double cell);

}  // namespace vegetation_sim::canopy
