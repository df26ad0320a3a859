// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/sensors/open_rays.h"

namespace vegetation_sim::scan {

SkyTransmittance countOpenRays(const Scene& scene, const Vec3& place, double reach, int rays,
                               const Random& random) {
  SkyTransmittance out;
  for (std::size_t bin = 0; bin < SKY_BINS; ++bin) {
    const SineRange sines = sinesOf(static_cast<int>(bin / SKY_AZIMUTHS));
    const double solid_angle = (sines.high - sines.low) / SKY_AZIMUTHS;  // over that of all bins
    const Random numbers = random.child(bin);
    for (int ray = 0; ray < rays; ++ray) {
      const auto index = 2 * static_cast<std::uint64_t>(ray);
      const double sine = numbers.uniform(index, sines.low, sines.high);
      const double azimuth = static_cast<double>(bin % SKY_AZIMUTHS) + numbers.uniform(index + 1);
      const Ray sight(place, skyDirection(sine, azimuth / SKY_AZIMUTHS));
      if (cast(scene, sight, reach).label != Label::NONE) continue;
      out.bins[bin] += 1.0 / rays;
      out.open_share += solid_angle / rays;
      out.sky_view_factor += 2.0 * sine * solid_angle / rays;
    }
  }
  return out;
}

}  // namespace vegetation_sim::scan
