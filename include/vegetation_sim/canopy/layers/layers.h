// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/canopy/layers/motion_history.h"
#include "vegetation_sim/canopy/layers/plane_view.h"
#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::canopy {

constexpr int MOST_LAYERS = 16;

/// Motion of a layer from the history (equation 3), or by one look-up (equation 5).
enum class LayerModel { HISTORY, LOOKUP };
/// Direction of the look-up: of unit length, or as the paper prints it (E9b).
enum class LookupDirection { UNIT, PRINTED };

/// How the layers behind the first move (paper 3, section 3.5).
struct LayerSettings {
  LayerModel model{LayerModel::HISTORY};
  Formula delay{Formula::DERIVED};  ///< of equation 4 (E9)
  LookupDirection direction{LookupDirection::UNIT};
  double delay_speed{2.0};  ///< V_D, speed at which motion goes through the layers in a calm [m/s]
  double spread{0.2};       ///< of V_D between layers, fixed for each (S3-21)
  double wave_speed{0.4};   ///< s of the look-up [m/s]
  double fade{1.0};         ///< between the drivers, when the wind in depth turns [s]
  double hysteresis{0.2};   ///< wind in depth below which the driver stays [m/s]
  double memory{1.0};       ///< length of the history [s]
};
void describe(FieldVisitor& visitor, LayerSettings& settings);

/// Equation 4 [s]. Right: -sgn(vz) L / (|vz| + V_D) with sgn(0) = -1, bounded by L / V_D. Printed:
/// L / (V_D - vz), with a pole (E9).
double layerDelay(double distance, double vz, double delay_speed, bool printed);
/// V_D of a layer: the same at any time (S3-21).
double delaySpeedOf(const LayerSettings& settings, std::uint64_t seed, int layer);

/// Which layer the wind meets first, and drives the others (S3-23): 1 the front, 0 the back, in
/// between while they cross-fade.
class Driver {
 public:
  double share() const { return share_; }
  bool front() const { return front_; }
  /// @param mean_vz mean motion towards the viewer [m/s].
  void advance(double dt, double mean_vz, const LayerSettings& settings);
  void restore(double share, bool front) { share_ = share, front_ = front; }

 private:
  double share_{1.0};
  bool front_{true};
};

/// Motion of one layer, in the plane and along its normal [m/s].
struct LayerMotion {
  PlaneField plane;
  std::vector<double> depth;
};

/// What all layers at one instant have in common.
struct LayerView {
  const LayerSettings* settings;
  const History* history;
  double tick;         ///< time between frames [s]
  Vec3 towards;        ///< the viewer's axis out of the picture, in the plane's components
  double front_share;  ///< of the front as the driver, 0 to 1
  double cell;         ///< width of a cell [m]
};

/// Motion of a layer: that of the first one some time ago (eq. 3), or elsewhere (eq. 5).
/// @param distance from the first layer [m]. @param last that of the last layer.
void layerMotion(const LayerView& view, double distance, double last, double delay_speed,
                 LayerMotion& out);

}  // namespace vegetation_sim::canopy
