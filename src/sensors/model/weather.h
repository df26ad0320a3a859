// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::scan {

/// Fog and rain between the sensor and the objects.
struct Weather {
  /// Distance at which a black object has a contrast of 2 % with the sky [m]; 0: no fog.
  double fog_visibility{0.0};
  double rain_rate{0.0};     ///< [mm/h]
  double rain_returns{1.0};  ///< drops that may give a return, over the extinction by rain
};
void describe(FieldVisitor& visitor, Weather& weather);

/// Returns the extinction by fog of a visibility [1/m] (Koschmieder 1924): ln(50) / visibility.
double fogExtinction(double visibility);
/// Returns the extinction by rain of a rate in mm/h [1/m] (Carbonneau and Wisely 1998, as in ITU-R
/// P.1814): 1.076 rate^0.67 dB/km.
double rainExtinction(double rate);

/// The air as rays meet it.
class Air {
 public:
  explicit Air(const Weather& weather);

  bool isClear() const { return extinction_ == 0.0; }
  /// Returns the share of light that passes a distance and the way back: exp(-2 extinction range).
  double transmission(double range) const;
  /// Returns the distance of the first drop that may give a return [m], at most infinite.
  /// @param share uniform number in [0, 1): of all rays, this share meets a drop before.
  double firstDrop(double share) const;
  double extinction() const { return extinction_; }  ///< [1/m]
  double drops() const { return drops_; }            ///< drops that may give a return [1/m]

 private:
  double extinction_, drops_;
};

}  // namespace vegetation_sim::scan
