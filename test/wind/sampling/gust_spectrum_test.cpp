// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/sampling/gust_spectrum.h"

#include <gtest/gtest.h>

namespace vegetation_sim::wind {
namespace {

double sumOf(const GustSpectrum& spectrum) {
  double out = 0.0;
  for (const auto& row : spectrum.power)
    for (const double power : row) out += power;
  return out;
}

// N7: nothing is lost between the points of the grid; slow wind counts less.
TEST(GustSpectrum, SharesOutWhatIsAdded) {
  GustSpectrum spectrum;
  spectrum.add(0.5, 0.3, 4.0);
  EXPECT_NEAR(sumOf(spectrum), 4.0, 1e-12);
  spectrum.add(50.0, 9.0, 1.0);  // beyond both ends: at the end
  EXPECT_NEAR(sumOf(spectrum), 5.0, 1e-12);
  EXPECT_NEAR(spectrum.power[2][11], 1.0, 1e-12);
  spectrum.add(0.5 * GustSpectrum::FREQUENCIES[0], 0.0, 4.0);
  EXPECT_NEAR(spectrum.power[0][0], 1.0, 1e-12);
}

// N7: a breeze oscillates with the variance of its modes, where it blows, and a disk at its own
// pulsation and within its radius; steady wind does not at all.
TEST(GustSpectrum, HoldsVariableWindByFrequency) {
  Primitive breeze;
  breeze.id = 1;
  breeze.name = "breeze";
  breeze.kind = Kind::BREEZE;
  breeze.fade_in = 0.0;
  breeze.velocity = Vec3(5.0, 0.0, 0.0);
  const Field windy({breeze}, 3);
  double variance = 0.0;
  for (const Mode& mode : windy.at(0).modes) variance += 0.5 * dot(mode.amplitude, mode.amplitude);
  const GustSpectrum spectrum = GustSpectrumField(windy, 0).at(Vec3::Zero(), 0.0);
  const double peak = GustSpectrumField::PEAK * GustSpectrumField::PEAK * variance;
  EXPECT_LE(sumOf(spectrum), peak);
  EXPECT_GE(sumOf(spectrum), 0.5 * peak);  // the rest is slower than the grid
  EXPECT_EQ(spectrum.power[2][3], 0.0);    // carried at 5 m/s: between 0 and 0.2 s/m
  breeze.turbulence = 0.0;
  EXPECT_EQ(sumOf(GustSpectrumField(Field({breeze}, 3), 0).at(Vec3::Zero(), 0.0)), 0.0);

  Primitive disk;
  disk.id = 2;
  disk.name = "disk";
  disk.fade_in = 0.0;
  disk.radius = 10.0;
  disk.velocity = Vec3(3.0, 4.0, 0.0);
  disk.omega = 2.0 * 3.14159265358979 * 0.3;
  const GustSpectrumField swaying(Field({disk}, 3), 0);
  EXPECT_NEAR(swaying.at(Vec3::Zero(), 0.0).power[0][5], 25.0, 1e-6);
  EXPECT_EQ(sumOf(swaying.at(Vec3(11.0, 0.0, 0.0), 0.5)), 0.0);
}

Primitive blast() {
  Primitive out;
  out.id = 3;
  out.name = "blast";
  out.kind = Kind::BLAST;
  out.trajectory = {{0, Vec3::Zero()}};
  out.radius = 10.0;
  out.speed = 8.0;
  out.fade_in = 0.0;
  return out;
}

// N7: a blast that stands still moves plants while it starts and shortly after, as half an
// oscillation of its height at the highest frequency, and then no more; a slow start moves them
// less.
TEST(GustSpectrum, HoldsTheStartOfABlastThatStandsStill) {
  const auto sumAt = [](const Primitive& p, double time) {
    return sumOf(GustSpectrumField(Field({p}, 3), fromSeconds(time)).at(Vec3(2.0, 0.0, 0.0), 8.0));
  };
  Primitive step = blast();
  EXPECT_NEAR(sumAt(step, 0.5), 16.0, 1e-9);
  EXPECT_EQ(sumAt(step, 5.0), 0.0);
  step.fade_in = 30.0;
  EXPECT_LT(sumAt(step, 29.0), 4.0);
  EXPECT_GT(sumAt(step, 29.0), 0.0);
}

// N7: a disk that passes acts at the frequency of its passage, though its own pulsation is slow.
TEST(GustSpectrum, HoldsADiskThatPasses) {
  Primitive disk;
  disk.id = 2;
  disk.name = "disk";
  disk.fade_in = 0.0;
  disk.radius = 5.0;
  disk.omega = 0.01;
  disk.velocity = Vec3(4.0, 0.0, 0.0);
  disk.trajectory = {{0, Vec3::Zero()}};
  const auto sumOfDisk = [&] {
    return sumOf(
        GustSpectrumField(Field({disk}, 3), fromSeconds(1.0)).at(Vec3(2.0, 0.0, 0.0), 8.0));
  };
  EXPECT_LT(sumOfDisk(), 0.1);
  disk.orbit_radius = 3.0;
  disk.orbit_period = 2.0;  // 9.4 m/s past 20 m: 0.47 Hz
  EXPECT_NEAR(sumOfDisk(), 16.0, 1e-9);
  const GustSpectrumField swinging(Field({disk}, 3), fromSeconds(1.0));
  EXPECT_TRUE(swinging.hasDisks());
  EXPECT_EQ(sumOf(swinging.withoutDisks(Vec3(2.0, 0.0, 0.0), 1.0)), 0.0);
  EXPECT_NEAR(swinging.at(Vec3(2.0, 0.0, 0.0), 8.0).peak, 4.0, 1e-9);
  EXPECT_EQ(swinging.withoutDisks(Vec3(2.0, 0.0, 0.0), 8.0).peak, 0.0);
}

}  // namespace
}  // namespace vegetation_sim::wind
