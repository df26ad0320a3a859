// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/exposure.h"

#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {

void describe(FieldVisitor& v, Exposure& e) {
  v.number("exposure", e.factor, "", {0.001, 1000.0});
  v.number("read_noise", e.read_noise, "", {0.0, 1.0});
  v.number("shot_noise", e.shot_noise, "", {0.0, 1.0});
}

std::uint8_t encode(double signal) {
  const double x = saturate(signal);
  const double value = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<std::uint8_t>(std::lround(255.0 * value));
}

Rgb8 develop(const Exposure& exposure, const Vec3& radiance, const RayRandom* random) {
  std::uint8_t out[3];
  for (int i = 0; i < 3; ++i) {
    double signal = exposure.factor * radiance[i];
    if (random)
      signal += std::sqrt(exposure.read_noise * exposure.read_noise +
                          exposure.shot_noise * exposure.shot_noise * signal) *
                random->unitNoise(i);
    out[i] = encode(signal);
  }
  return {out[0], out[1], out[2]};
}

}  // namespace vegetation_sim::scan
