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

/// Motion of a layer from the history (equation 3) or by one look-up (equation 5).
enum class LayerModel { HISTORY, LOOKUP };
/// Direction of the look-up: of unit length, or as the paper prints it (E9b).
enum class LookupDirection { UNIT, PRINTED };

/// Motion of the layers behind the first (paper 3, section 3.5).
struct LayerSettings {
  LayerModel model{LayerModel::HISTORY};
  Formula delay{Formula::DERIVED};  ///< form of equation 4 (E9)
  LookupDirection direction{LookupDirection::UNIT};
  /// V_D, speed at which motion passes through the layers in calm air [m/s]
  double delay_speed{2.0};
  double spread{0.2};      ///< relative variation of V_D between layers, constant for each (S3-21)
  double wave_speed{0.4};  ///< s of the look-up [m/s]
  double fade{1.0};        ///< transition between drivers when the wind in depth turns [s]
  double hysteresis{0.2};  ///< wind in depth below which the driver does not change [m/s]
  double memory{1.0};      ///< length of the history [s]
};
void describe(FieldVisitor& visitor, LayerSettings& settings);

/// Returns the delay of equation 4 [s]. As derived it is -sgn(vz) L / (|vz| + V_D) with sgn(0) =
/// -1, bounded by L / V_D. As printed it is L / (V_D - vz), with a pole (E9).
double layerDelay(double distance, double vz, double delay_speed, bool printed);
/// Returns V_D of a layer, which is constant in time (S3-21).
double delaySpeedOf(const LayerSettings& settings, std::uint64_t seed, int layer);

/// Selects the layer that the wind meets first and that drives the others (S3-23): share 1 is the
/// front, 0 the back, and values between them a cross-fade.
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

/// Inputs that all layers share at one instant.
struct LayerView {
  const LayerSettings* settings;
  const History* history;
  double tick;         ///< time between frames [s]
  Vec3 towards;        ///< axis from the plane towards the viewer, in the plane's components
  double front_share;  ///< share of the front as the driver, 0 to 1
  double cell;         ///< width of a cell [m]
};

/// Computes the motion of a layer: that of the first layer some time ago (eq. 3), or at another
/// place (eq. 5). @param distance from the first layer [m]. @param last distance of the last layer
/// [m].
void layerMotion(const LayerView& view, double distance, double last, double delay_speed,
                 LayerMotion& out);

}  // namespace vegetation_sim::canopy
