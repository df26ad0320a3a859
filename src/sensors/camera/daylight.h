// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::scan {

/// Sun and air of a picture. The default sun is that of the displays.
struct Weatherlight {
  double sun_azimuth{-0.876};     ///< counter-clockwise from x [rad]
  double sun_elevation{0.671};    ///< [rad]
  double fog_visibility{5000.0};  ///< as in Weather [m]; 0: clear air
};
void describe(FieldVisitor& visitor, Weatherlight& light);

/// Light of sun and sky in linear red, green and blue. A white surface that faces the sun of noon
/// has about 3.
class Daylight {
 public:
  explicit Daylight(const Weatherlight& light);

  /// Unit vector towards the sun.
  const Vec3& toSun() const { return to_sun_; }
  const Vec3& sun() const { return sun_; }
  /// Returns the light of sky and ground that a surface receives. @param up vertical component of
  /// its normal. @param sky share of the sky that it sees.
  Vec3 ambient(double up, double sky) const;
  /// Returns the radiance of the sky in a direction, with sun and clouds.
  Vec3 skyTowards(const Vec3& direction) const;
  /// Returns what comes through the air from an object of this radiance at a distance [m]: the
  /// share exp(-extinction distance), and light of the horizon for the rest (Koschmieder 1924).
  Vec3 through(const Vec3& radiance, double distance) const;

 private:
  Vec3 to_sun_, sun_;
  double extinction_;  ///< of the air [1/m]
};

}  // namespace vegetation_sim::scan
