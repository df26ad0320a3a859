// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/laws.h"

#include <gtest/gtest.h>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::wind {
namespace {

TEST(Disk, HoldsTheReferenceVector) {  // S1-15
  const Field field({printedDisk()});
  EXPECT_NEAR(length(field.velocity(Vec3(0.0, 4.0, 0.0), at(0.3))), 1.693927, 1e-6);
}

TEST(Disk, SecondDerivativeInTimeIsMinusOmegaSquaredTimesItself) {  // S1-15, S1-26
  const Field field({printedDisk()});
  const Vec3 position(0.0, 4.0, 0.0);
  const double h = 1e-3;  // truncation w^4 f h^2 / 12 = 2e-6
  const auto speed = [&](double t) { return field.velocity(position, at(t)).x(); };
  const double second = (speed(0.3 + h) - 2.0 * speed(0.3) + speed(0.3 - h)) / (h * h);
  EXPECT_NEAR(second, -6.775709, 1e-5);
}

TEST(Disk, IsContinuousAtItsEdgeAndNothingBeyond) {  // S1-15
  const Field field({printedDisk()});
  EXPECT_EQ(length(field.velocity(Vec3(10.0, 0.0, 0.0), at(0.3))), 0.0);
  EXPECT_EQ(length(field.velocity(Vec3(10.1, 0.0, 0.0), at(0.3))), 0.0);
  EXPECT_NEAR(length(field.velocity(Vec3(10.0 - 1e-9, 0.0, 0.0), at(0.3))), 0.0, 1e-9);
}

TEST(Disk, MeasuresDistanceInTheHorizontalPlane) {  // E3
  Primitive disk = printedDisk();
  disk.trajectory = {{0, Vec3(1.0, 2.0, 30.0)}};
  const Field field({disk});
  const Vec3 low = field.velocity(Vec3(4.0, 6.0, -20.0), at(0.3));
  EXPECT_NEAR(length(low), 0.5 * 5.0 * sinCos(0.6).sin, 1e-12);  // d = 5
  EXPECT_EQ(low, field.velocity(Vec3(4.0, 6.0, 500.0), at(0.3)));
}

TEST(Disk, PhaseShiftsTheZeroCrossing) {  // S1-16
  Primitive disk = printedDisk();
  disk.phase = 0.7;
  const Field field({disk});
  const double zero = (PI - disk.phase) / disk.omega;  // sin(w t + psi) = 0 on the way down
  EXPECT_NEAR(field.velocity(Vec3::Zero(), at(zero)).x(), 0.0, 1e-8);  // stamps are whole ns
  EXPECT_GT(field.velocity(Vec3::Zero(), at(zero - 0.01)).x(), 0.05);
  EXPECT_LT(field.velocity(Vec3::Zero(), at(zero + 0.01)).x(), -0.05);
  EXPECT_NEAR(field.velocity(Vec3::Zero(), 0).x(), 5.0 * sinCos(0.7).sin, 1e-12);
}

TEST(Disk, ReachesAPointAtThePredictedTime) {  // S1-17
  Primitive disk = printedDisk();
  disk.radius = 3.0;
  disk.trajectory = {{at(0.0), Vec3(-20.0, 0.0, 0.0)}, {at(10.0), Vec3(0.0, 0.0, 0.0)}};
  const Field field({disk});
  const Vec3 tree(5.0, 0.0, 0.0);
  const double arrival = (25.0 - 3.0) / 2.0;  // its edge, at 2 m/s, beyond the last way point
  EXPECT_EQ(length(field.velocity(tree, at(arrival - 0.01))), 0.0);
  EXPECT_NE(length(field.velocity(tree, at(arrival + 0.01))), 0.0);
}

TEST(Disk, RunsCounterClockwiseOnItsOrbit) {  // S1-17
  Primitive disk = printedDisk();
  disk.radius = 1.0;
  disk.orbit_radius = 10.0;
  disk.orbit_period = 8.0;
  disk.epoch = at(3.0);
  disk.trajectory = {{0, Vec3(5.0, 5.0, 0.0)}};
  const Field field({disk});
  const double full = 5.0 * sinCos(2.0 * 2.0).sin;  // a quarter of a round after the epoch
  EXPECT_NEAR(field.velocity(Vec3(5.0, 15.0, 0.0), at(5.0)).x(), full, 1e-9);
  EXPECT_EQ(length(field.velocity(Vec3(15.0, 5.0, 0.0), at(5.0))), 0.0);
}

TEST(Disk, SmoothEnvelopeIsTheC2StepOfThePrintedOne) {  // S1-15, E1
  Primitive disk = printedDisk();
  disk.envelope = Envelope::SMOOTH;
  const Field smooth({disk}), printed({printedDisk()});
  for (const double d : {0.0, 2.0, 5.0, 9.0}) {
    const double u = (10.0 - d) / 10.0, full = 5.0 * sinCos(0.6).sin;
    EXPECT_NEAR(printed.velocity(Vec3(d, 0.0, 0.0), at(0.3)).x(), full * u, 1e-12);
    EXPECT_NEAR(smooth.velocity(Vec3(d, 0.0, 0.0), at(0.3)).x(), full * smootherStep(u), 1e-12);
  }
}

TEST(Gust, FrontMovesAtItsSpeed) {  // S2-20, S1-W1
  Primitive gust = example(Kind::GUST);
  gust.velocity = Vec3(0.0, 8.0, 0.0);
  gust.front_speed = 5.0;
  gust.radius = 10.0;
  const Field field({gust});
  // There is no wind ahead of the front, everything within its rise (5 m), and none behind the tail
  // (40 m).
  for (const double t : {0.0, 3.0, 20.0}) {
    const double front = 5.0 * t;
    EXPECT_EQ(length(field.velocity(Vec3(0.0, front + 0.01, 0.0), at(t))), 0.0);
    EXPECT_NEAR(field.velocity(Vec3(0.0, front - 2.5, 0.0), at(t)).y(), 4.0, 1e-9);
    EXPECT_NEAR(field.velocity(Vec3(0.0, front - 10.0, 0.0), at(t)).y(), 8.0, 1e-9);
    EXPECT_EQ(length(field.velocity(Vec3(0.0, front - 40.0, 0.0), at(t))), 0.0);
  }
}

TEST(Gust, BlowsWithinItsWidthOnly) {  // S2-20
  Primitive gust = example(Kind::GUST);
  gust.velocity = Vec3(8.0, 0.0, 0.0);
  const Field field({gust});  // radius 10 m, at t = 3 s the plateau lies at 3 to 13 m
  EXPECT_NEAR(field.velocity(Vec3(8.0, 5.0, 0.0), at(3.0)).x(), 8.0 * smootherStep(0.5), 1e-12);
  EXPECT_EQ(field.velocity(Vec3(8.0, 5.0, 0.0), at(3.0)),
            field.velocity(Vec3(8.0, -5.0, 9.0), at(3.0)));
  EXPECT_EQ(length(field.velocity(Vec3(8.0, 10.0, 0.0), at(3.0))), 0.0);
}

TEST(Gust, PassesAgainEachRepeatAndFadesAtTheWrap) {  // S2-20
  Primitive gust = example(Kind::GUST);
  gust.repeat = 10.0;
  const Field field({gust});
  const Vec3 position(8.0, 0.0, 0.0);
  EXPECT_NEAR(field.velocity(position, at(3.0)).x(), 5.0, 1e-12);
  EXPECT_NEAR(field.velocity(position, at(43.0)).x(), 5.0, 1e-12);
  EXPECT_EQ(length(field.velocity(Vec3(-6.0, 0.0, 0.0), at(20.0))), 0.0);
  EXPECT_LT(length(field.velocity(Vec3(50.0, 0.0, 0.0), at(19.9))), 0.05);
}

TEST(Tornado, IsTangentialWithInflowAndUpdraft) {  // S2-20, S1-W1
  Primitive tornado = example(Kind::TORNADO);
  tornado.speed = 12.0;
  tornado.core_radius = 2.0;
  tornado.radius = 1e4;  // so wide that its envelope is 1 here
  tornado.inflow = 0.25;
  tornado.updraft = 0.5;
  const Field field({tornado});
  const double envelope = 1e-9;  // 10 (d / radius)^3
  const Vec3 peak = field.velocity(Vec3(2.0, 0.0, 7.0), 0);
  EXPECT_NEAR(peak.y(), 12.0, 12.0 * envelope);  // counter-clockwise
  EXPECT_NEAR(peak.x(), -3.0, 12.0 * envelope);
  EXPECT_NEAR(peak.z(), 3.0, 12.0 * envelope);
  EXPECT_NEAR(field.velocity(Vec3::Zero(), 0).z(), 6.0, 12.0 * envelope);
  const Vec3 out = field.velocity(Vec3(0.0, 8.0, 0.0), 0);  // rho = 4: 2 rho / (1 + rho^2) = 8/17
  EXPECT_NEAR(out.x(), -12.0 * 8.0 / 17.0, 12.0 * 1e-8);
  EXPECT_NEAR(out.y(), -0.25 * 12.0 * 8.0 / 17.0, 12.0 * 1e-8);
}

TEST(Tornado, EndsAtItsRadius) {  // S2-20
  const Field field({example(Kind::TORNADO)});
  EXPECT_EQ(length(field.velocity(Vec3(10.0, 0.0, 0.0), 0)), 0.0);
  EXPECT_GT(length(field.velocity(Vec3(9.0, 0.0, 0.0), 0)), 0.0);
}

TEST(Blast, BlowsOutwardFromAMovingCentreInThreeDimensions) {  // S1-W1, N12
  Primitive blast = example(Kind::BLAST);
  blast.speed = 9.0;
  blast.core_radius = 1.0;
  blast.radius = 1e4;
  blast.trajectory = {{at(0.0), Vec3(0.0, 0.0, 5.0)}, {at(1.0), Vec3(1.0, 0.0, 5.0)}};
  const Field field({blast});
  const Vec3 below = field.velocity(Vec3(4.0, 0.0, 4.0), at(4.0));  // the body is at (4, 0, 5)
  EXPECT_NEAR(below.z(), -9.0, 1e-8);
  EXPECT_NEAR(below.x(), 0.0, 1e-12);
  EXPECT_EQ(length(field.velocity(Vec3(4.0, 0.0, 5.0), at(4.0))), 0.0);
  const Vec3 slanted = field.velocity(Vec3(4.0, 3.0, 1.0), at(4.0));  // d = 5, along (0, 3, -4) / 5
  EXPECT_NEAR(slanted.y(), 9.0 * 10.0 / 26.0 * 0.6, 1e-8);
  EXPECT_NEAR(slanted.z(), 9.0 * 10.0 / 26.0 * -0.8, 1e-8);
}

}  // namespace
}  // namespace vegetation_sim::wind
