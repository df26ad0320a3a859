// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/layers/layers.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// WARP moves the points of a grid; BEND turns leaves about their feet, so that no point leaves its
/// foot (S3-W4).
enum class WarpMethod { WARP, BEND };

/// How far a motion carries a leaf (paper 3, equations 6 and 7).
struct WarpSettings {
  Formula form{Formula::DERIVED};  ///< of depthShare() and of the displacement (E10)
  /// Scale across, up, and of the shrink that stands for motion in depth (S3-25, S3-26).
  Vec3 lambda{Vec3(1.0, 1.0, 0.5)};
  double reference_time{0.05};  ///< displacement per speed [s]
  double depth_loss{0.3};       ///< m: share that the last layer moves less
  double rigidity{1.5};         ///< r of equation 7; 0: every part moves alike
  WarpMethod method{WarpMethod::WARP};
  /// Tangent of a leaf's turn about its midrib per displacement of its tip across its face, over
  /// its length (S3-W3).
  double twist{0.3};
};
void describe(FieldVisitor& visitor, WarpSettings& settings);

/// R of equation 7: (height / top)^rigidity, from 0 at the root to 1 at the top. With a rigidity of
/// 0 it is 1, at the root too; a plant of no height stays still unless that holds.
double mobility(double height, double top, double rigidity);

/// Share of a layer's motion that is seen. Right: 1 - m ratio^2; printed: (1 - ratio^2) m. One
/// layer, or no depth: ratio 0.
double depthShare(const WarpSettings& settings, double distance, double last);

/// Displacement [m] to the right, up and 0 of a leaf whose layer moves by `velocity` [m/s] in the
/// view's axes. The printed form is proportional to the step `dt`; the right one does not know it.
Vec3 displacement(const WarpSettings& settings, const Vec3& velocity, double share, double dt);

/// The displacement that keeps the distance of `arm`, from foot to point: a bend, not a shear.
Vec3 bent(const Vec3& arm, const Vec3& displacement);

/// `side`, at right angles to the midrib `along`, turned about it by what displaces the tip across
/// the leaf's face: by less than a quarter turn.
Vec3 twisted(const WarpSettings& settings, const Vec3& along, const Vec3& side,
             const Vec3& displacement);

/// Weakens what differs from the mean of the layer until no two points change places, however the
/// motion is turned into the view: with gradients of at most a half the map has an inverse.
/// @param reach displacement per motion, the largest of all axes [s]. @return the weakening, 0
/// to 1.
double limitFolding(LayerMotion& motion, double reach, double cell);

}  // namespace vegetation_sim::canopy
