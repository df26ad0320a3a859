// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "ros/params/parameters.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim {

/// Parameters that all sensors have; see docs/reference.md.
struct SensorOptions {
  std::string frame_id{"map"};  ///< world frame
  std::uint64_t seed{0};        ///< of the noise
  int rate{10};                 ///< measurements per second [Hz]
  double delay{0.1};            ///< how far measurements stay behind the clock [s]
  double tolerance{0.05};       ///< error that branches in range may have [m]
  int branch_budget{400000};    ///< most branches that rays can meet
  int leaf_budget{200000};      ///< most leaves of plants that rays can meet
  int threads{1};               ///< of a measurement
};
/// Visits the numbers but the rate.
void describe(FieldVisitor& visitor, SensorOptions& options);
/// Reads the rest but the rate.
void readNames(Parameters& parameters, SensorOptions& options);

/// Returns an empty scene with the budgets of the options.
scan::Scene makeScene(const SensorOptions& options);

}  // namespace vegetation_sim
