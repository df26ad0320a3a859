// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/canopy/flow/wind_sources.h"

#include <gtest/gtest.h>

#include "scenes/canopy/plane_scene.h"
#include "vegetation_sim/canopy/flow/fluid.h"

namespace vegetation_sim::canopy {
namespace {

PlaneVector meanOf(const PlaneField& field) {
  PlaneVector out;
  for (std::size_t i = 0; i < field.u.size(); ++i) {
    out.u += field.u[i] / static_cast<double>(field.u.size());
    out.v += field.v[i] / static_cast<double>(field.v.size());
  }
  return out;
}

FluidSettings small() {
  FluidSettings out;
  out.cells = 32;
  return out;
}

// S3-13
TEST(Sources, BlowFromEachSideTheirOwnWay) {
  for (std::size_t side = 0; side < SIDES; ++side) {
    SourceSettings settings;
    settings.sides[side].strength = 4.0;
    Fluid fluid(small(), settings, 1);
    for (int i = 0; i < 120; ++i) fluid.advance(i / 30.0, 1.0 / 30.0);
    const PlaneVector mean = meanOf(fluid.state().flow);
    const double along = (side < 2 ? mean.u : mean.v) * (side % 2 ? -1.0 : 1.0);
    EXPECT_GT(along, 1.0) << side;
    EXPECT_LT(std::abs(side < 2 ? mean.v : mean.u), 0.3 * along) << side;
  }
}

// S3-13: the wind comes in at its side, not everywhere at once.
TEST(Sources, BringWindInAtTheBandOnly) {
  SourceSettings settings;
  settings.sides[0].strength = 4.0;
  PlaneField flow(64);
  Sources(settings, 64, 1).apply({0.0, 0.1, 0}, nullptr, Turbulence{}, flow);
  EXPECT_GT(flow.u[32 * 64 + 0], 1.0);
  EXPECT_EQ(flow.u[32 * 64 + 12], 0.0);
  EXPECT_EQ(flow.u[32 * 64 + 63], 0.0);
}

// S3-13
TEST(Sources, SwellWithTheirFrequency) {
  SourceSettings settings;
  settings.sides[1] = {2.0, 0.5};
  settings.steadiness = 0.25;
  const Sources sources(settings, 32, 1);
  EXPECT_NEAR(sources.swell(1, {0.5, 1e-6, 0}), 2.0, 1e-9);   // a quarter of a period: full
  EXPECT_NEAR(sources.swell(1, {1.5, 1e-6, 0}), 0.5, 1e-9);   // three quarters: what is steady
  EXPECT_NEAR(sources.swell(1, {7.3, 2.0, 0}), 1.25, 1e-12);  // the mean of a period
}

// A swell of 60 Hz seen at 60 Hz stands still at its mean and does not beat.
TEST(Sources, DoNotAliasASwellFasterThanTheSteps) {
  SourceSettings settings;
  settings.sides[0] = {2.0, 60.0};
  const Sources sources(settings, 32, 1);
  for (int i = 0; i < 100; ++i)
    EXPECT_NEAR(sources.swell(0, {i / 60.0, 1.0 / 60.0, 0}), 1.4, 1e-9) << i;
}

TEST(Sources, FluctuateTheSameAtAnyStep) {
  SourceSettings settings;
  settings.sides[0].strength = 1.0;
  for (const double dt : {0.01, 0.1, 1.0}) {
    const Sources sources(settings, 32, 5);
    Turbulence turbulence{};
    double square = 0.0;
    constexpr int COUNT = 6000;
    for (int i = 0; i < COUNT; ++i) {
      sources.carryOn({i * dt, dt, static_cast<std::uint64_t>(i)}, turbulence);
      for (const double value : turbulence) square += value * value;
    }
    // Variance 1 / TURBULENCE_MODES each; at 0.01 s there are 60 correlation times of 32 values.
    EXPECT_NEAR(square / COUNT / static_cast<double>(turbulence.size()) * TURBULENCE_MODES, 1.0,
                0.15)
        << dt;
  }
}

// Swell of the mean wind in the plane over eight periods of 2 s [m/s].
double swellAt(double rate, int scheme) {
  SourceSettings settings;
  settings.sides[0] = {6.0, 0.5};
  settings.turbulence = 0.0;
  FluidSettings fluid_settings = small();
  fluid_settings.scheme = static_cast<Scheme>(scheme);
  Fluid fluid(fluid_settings, settings, 1);
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < 24 * rate; ++i) {
    fluid.advance(i / rate, 1.0 / rate);
    if (i < 8 * rate) continue;
    const double u = meanOf(fluid.state().flow).u;
    sum += u, squares += u * u;
  }
  const double count = 16.0 * rate;
  return std::sqrt(squares / count - (sum / count) * (sum / count));
}

// E10: pressure spreads the push of the band over the plane while it acts. The schemes that project
// once a step lose what the band cannot take up: 4 to 11 % from 240 to 30 Hz.
TEST(Sources, SwellTheSameAtAnyRate) {
  const double swell = swellAt(240.0, 0);
  EXPECT_GT(swell, 0.2);
  for (const double rate : {60.0, 30.0, 20.0, 15.0, 5.0})
    EXPECT_NEAR(swellAt(rate, 0) / swell, 1.0, 0.01) << rate;
  EXPECT_LT(swellAt(30.0, 1), 0.92 * swell);
}

TEST(Sources, CalmDownWithoutWind) {
  FluidState state;
  state.flow = smoothFlow(32, 2);
  Fluid fluid(small(), {}, 1);
  fluid.restore(state);
  for (int i = 0; i < 300; ++i) fluid.advance(i / 30.0, 1.0 / 30.0);
  EXPECT_LT(energyOf(fluid.state().flow), energyOf(state.flow));
  EXPECT_EQ(fluid.figures().resets, 0U);
}

// S3-08, S3-10: the wind law that blows on the trees blows on the plane.
TEST(Sources, FollowTheWindLaw) {
  PlaneAir air;
  for (PlaneVector& node : air.nodes) node = {3.0, -1.0};
  Fluid fluid(small(), {}, 1);
  for (int i = 0; i < 150; ++i) fluid.advance(i / 30.0, 1.0 / 30.0, &air);
  PlaneVector mean = meanOf(fluid.state().flow);
  EXPECT_NEAR(mean.u, 3.0, 0.05);
  EXPECT_NEAR(mean.v, -1.0, 0.05);
  for (PlaneVector& node : air.nodes) node = {-3.0, 0.0};
  for (int i = 150; i < 300; ++i) fluid.advance(i / 30.0, 1.0 / 30.0, &air);
  mean = meanOf(fluid.state().flow);
  EXPECT_NEAR(mean.u, -3.0, 0.05);
}

}  // namespace
}  // namespace vegetation_sim::canopy
