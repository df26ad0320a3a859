// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/weather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim::scan {
namespace {

// Koschmieder: a black object at the distance of the visibility has a contrast of 2 %.
TEST(Weather, FogLeavesTwoPercentContrastAtTheVisibility) {
  for (const double visibility : {20.0, 150.0, 1000.0})
    EXPECT_NEAR(std::exp(-fogExtinction(visibility) * visibility), 0.02, 1e-5);
  EXPECT_EQ(fogExtinction(0.0), 0.0);
}

// ITU-R P.1814 gives 1.076 dB/km at 1 mm/h and 9.30 dB/km at 25 mm/h.
TEST(Weather, RainHasTheSpecificAttenuationOfItsRate) {
  const auto decibels = [](double rate) {
    return 10.0 * std::log10(std::exp(1000.0 * rainExtinction(rate)));
  };
  EXPECT_NEAR(decibels(1.0), 1.076, 1e-3);
  EXPECT_NEAR(decibels(25.0), 9.30, 0.01);
  EXPECT_EQ(rainExtinction(0.0), 0.0);
}

TEST(Weather, LightIsLostOnBothWays) {
  const Air air({100.0, 10.0, 1.0});
  EXPECT_NEAR(air.extinction(), fogExtinction(100.0) + rainExtinction(10.0), 1e-15);
  EXPECT_NEAR(air.transmission(30.0), std::exp(-60.0 * air.extinction()), 1e-12);
  const Air clear{Weather()};
  EXPECT_TRUE(clear.isClear());
  EXPECT_EQ(clear.transmission(1e3), 1.0);
  EXPECT_EQ(clear.firstDrop(0.7), std::numeric_limits<double>::infinity());
}

// The distances are exponentially distributed. Bounds: four standard errors.
TEST(Weather, TheFirstDropIsExponentiallyDistributed) {
  const Air air({0.0, 50.0, 2.0});
  EXPECT_NEAR(air.drops(), 2.0 * rainExtinction(50.0), 1e-15);
  constexpr int N = 20000;
  const Random random(3);
  double sum = 0.0;
  int before = 0;
  for (std::uint64_t i = 0; i < N; ++i) {
    const double distance = air.firstDrop(random.uniform(i));
    sum += distance;
    before += distance < 40.0;
  }
  const double mean = 1.0 / air.drops(), share = 1.0 - std::exp(-40.0 * air.drops());
  EXPECT_NEAR(sum / N, mean, 4.0 * mean / std::sqrt(N));
  EXPECT_NEAR(double(before) / N, share, 4.0 * std::sqrt(share * (1.0 - share) / N));
}

}  // namespace
}  // namespace vegetation_sim::scan
