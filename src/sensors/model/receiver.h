// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "sensors/model/hit_merging.h"
#include "sensors/model/ray_random.h"
#include "sensors/model/sensor_model.h"

namespace vegetation_sim::scan {

/// How a point was chosen among the echoes of its beam, with the numbers of common drivers. FIRST:
/// the nearer one of two points.
enum class ReturnType : std::uint8_t {
  NONE,  ///< no point
  SINGLE_STRONGEST,
  SINGLE_LAST,
  DUAL_STRONGEST_FIRST,
  DUAL_STRONGEST_LAST,
  DUAL_WEAK_FIRST,
  DUAL_WEAK_LAST,
  DUAL_ONLY
};

/// One measurement.
struct Return {
  /// Range with noise [m]; infinite: nothing within range_max; -infinite: too near.
  double range{0.0};
  Hit hit;                ///< the nearest one if no echo became a point
  double intensity{0.0};  ///< share of the light that comes back, without the loss by distance
  ReturnType type{ReturnType::NONE};
  bool isPoint() const { return range > 0.0 && range < std::numeric_limits<double>::infinity(); }
};

/// Turns the echoes of a beam into returns.
class Receiver {
 public:
  Receiver(const SensorModel& model, double range_min, double range_max);

  /// Returns how many returns a beam has: 2 if both are wanted.
  int returns() const { return model_.returns == ReturnMode::BOTH ? 2 : 1; }
  /// Returns whether receive() needs random numbers.
  bool isRandom() const;
  /// Sets returns() returns. @param echoes nearest first; a raindrop may be added. @param random
  /// may be null unless isRandom(). @param detected scratch.
  void receive(std::vector<Echo>& echoes, const RayRandom* random, std::vector<Return>& detected,
               Return* out) const;

 private:
  void addDrop(const RayRandom& random, std::vector<Echo>& echoes) const;
  bool detect(const std::vector<Echo>& echoes, const RayRandom* random,
              std::vector<Return>& detected) const;
  void choose(const std::vector<Return>& detected, Return* out) const;

  SensorModel model_;
  Air air_;
  double range_min_, range_max_;
};

}  // namespace vegetation_sim::scan
