// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// The air that a moving body drags along (N11).
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/wind/wind_examples.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"
#include "wind/laws.h"

namespace vegetation_sim::wind {
namespace {

constexpr double RADIUS = 0.8, SPEED = 12.0, INFLOW = 0.25;  // [m], [m/s]

/// A car that passes the origin at time 0 along +x, its middle 1 m above the ground.
Primitive car() {
  Primitive p = example(Kind::WAKE);
  p.radius = RADIUS;
  p.inflow = INFLOW;
  p.plateau_length = 40.0;
  p.decay_length = 10.0;
  p.trajectory = {{at(10.0), Vec3(0.0, 0.0, 1.0)}, {at(11.0), Vec3(SPEED, 0.0, 1.0)}};
  return p;
}

Vec3 behind(const Instant& wind, double s, double beside, double above) {
  return wind.velocity(Vec3(-s, beside, 1.0 + above));
}

TEST(Wake, FallsAndWidensByThePowersOfTheFarField) {  // N11
  const Instant wind = Field({car()}).at(at(10.0));
  for (const double s : {0.0, 1.0, 2.4, 7.0, 16.8, 40.0}) {
    const double growth = 1.0 + s / (3.0 * RADIUS);
    const double width = RADIUS * std::cbrt(growth);
    const double axis = INFLOW * SPEED * std::pow(growth, -2.0 / 3.0);
    EXPECT_NEAR(behind(wind, s, 0.0, 0.0).x(), axis, 1e-12) << s;
    EXPECT_NEAR(behind(wind, s, width, 0.0).x(), axis * std::exp(-1.0), 1e-12) << s;
    EXPECT_NEAR(behind(wind, s, 0.0, -width).x(), axis * std::exp(-1.0), 1e-12) << s;
    EXPECT_EQ(behind(wind, s, 0.6 * 3.001 * width, 0.8 * 3.001 * width), Vec3(Vec3::Zero())) << s;
    EXPECT_EQ(behind(wind, s, 1.0, 0.0).y(), 0.0);
    EXPECT_EQ(behind(wind, s, 1.0, 0.0).z(), 0.0);
  }
}

/// Returns the integral of the speed over the plane at s [m^3/s], in rings of equal steps.
double fluxThrough(const Instant& wind, double s) {
  constexpr int RINGS = 4000;
  const double edge = 3.0 * RADIUS * std::cbrt(1.0 + s / (3.0 * RADIUS)), step = edge / RINGS;
  double sum = 0.0;
  for (int i = 0; i < RINGS; ++i) {
    const double b = (i + 0.5) * step;
    sum += behind(wind, s, 0.6 * b, 0.8 * b).x() * 2.0 * PI * b * step;
  }
  return sum;
}

// A wake keeps its momentum: to first order in the speed its flux is U times this integral. The
// end of the profile at three widths costs 0.3 % of that of the whole Gaussian, pi r^2 inflow U.
TEST(Wake, CarriesTheSameMomentumThroughEveryCrossSection) {  // N11
  const Instant wind = Field({car()}).at(at(10.0));
  const double first = fluxThrough(wind, 0.0);
  EXPECT_NEAR(first, INFLOW * SPEED * PI * RADIUS * RADIUS, 0.003 * first);
  for (const double s : {0.5, 2.0, 8.0, 20.0, 40.0})
    EXPECT_NEAR(fluxThrough(wind, s), first, 1e-6 * first) << s;  // error of the rings
}

TEST(Wake, IsBehindTheBodyAndEndsAtItsLength) {  // N11
  const Instant wind = Field({car()}).at(at(10.0));
  EXPECT_EQ(behind(wind, -RADIUS, 0.0, 0.0), Vec3(Vec3::Zero()));
  EXPECT_EQ(behind(wind, 50.0, 0.0, 0.0), Vec3(Vec3::Zero()));
  EXPECT_GT(behind(wind, 49.0, 0.0, 0.0).x(), 0.0);
  double largest = 0.0;
  for (double s = -RADIUS; s < 50.0; s += 0.001)
    largest = std::max(largest, behind(wind, s, 0.0, 0.0).x());
  EXPECT_LE(largest, wind.terms.at(0).peak);
  EXPECT_GT(largest, 0.99 * wind.terms.at(0).peak);
}

TEST(Wake, FollowsTheDirectionOfItsBody) {  // N11
  Primitive p = car();
  p.trajectory = {{at(10.0), Vec3(5.0, 5.0, 1.0)}, {at(11.0), Vec3(5.0 - 3.0, 5.0 + 4.0, 1.5)}};
  const Field field({p});
  const Vec3 n(-0.6, 0.8, 0.0), body(5.0, 5.0, 1.0);
  const Vec3 air = field.velocity(body - 2.4 * n, at(10.0));
  EXPECT_LT(length(air - n * (5.0 * INFLOW * std::pow(2.0, -2.0 / 3.0))), 1e-9);
  EXPECT_EQ(field.velocity(body + 2.4 * n, at(10.0)), Vec3(Vec3::Zero()));
  const Vec3 there = body + 5.0 * n + Vec3(0.0, 0.0, 0.5);
  EXPECT_LT(length(field.velocity(there - 2.4 * n, at(11.0)) - air), 1e-9);
}

TEST(Wake, OfABodyAtRestIsNothing) {  // N11
  Primitive p = car();
  p.trajectory = {{0, Vec3(0.0, 0.0, 1.0)}};
  EXPECT_TRUE(Field({p}).at(at(10.0)).terms.empty());
  p.trajectory.push_back({at(20.0), Vec3(0.0, 0.0, 9.0)});  // straight up
  EXPECT_TRUE(Field({p}).at(at(10.0)).terms.empty());
  EXPECT_EQ(Field({p}).velocity(Vec3(0.0, 0.0, 1.0), at(10.0)), Vec3(Vec3::Zero()));
}

// E1: third differences fall eight times where the second derivative is continuous, even at the
// turning points of a body that goes to and fro, where the direction jumps, and at way points.
TEST(Wake, IsTwiceDifferentiableWhereItsBodyTurnsBack) {
  Primitive p = car();
  p.trajectory.clear();
  for (int i = 0; i < 9; ++i) p.trajectory.push_back({at(2.0 * i), Vec3(i % 2, 0.0, 1.0)});
  const Field field({p});
  for (const double x : {-1.0, 0.4, 1.5}) {
    const auto largest = [&](double h) {
      double out = 0.0;
      const auto f = [&](double t) { return field.velocity(Vec3(x, 0.1, 1.0), at(t)).x(); };
      for (double t = 3.0; t < 11.0; t += h)
        out = std::max(out, std::fabs(f(t + 3 * h) - 3 * f(t + 2 * h) + 3 * f(t + h) - f(t)));
      return out;
    };
    const double coarse = largest(1.0 / 256);
    EXPECT_GT(coarse, 1e-8);
    EXPECT_GT(coarse / largest(1.0 / 512), 6.5) << x;
  }
}

TEST(Wake, IsBoundedWhereItComesWithinASecond) {  // S1-22, S1-40
  const Instant wind = Field({car()}).at(at(10.0));
  const double reach = 2.0;
  EXPECT_GT(wind.speedBound(Vec3(SPEED, 0.0, 0.0), 0.0), 0.0);
  EXPECT_EQ(wind.speedBound(Vec3(SPEED + 3.0, 0.0, 0.0), reach), 0.0);
  EXPECT_EQ(wind.speedBound(Vec3(-20.0, 8.0, 0.0), reach), 0.0);
  EXPECT_LE(wind.speedBound(Vec3(0.0, 0.0, 0.0), reach), wind.terms.at(0).peak);
  EXPECT_LT(wind.speedBound(Vec3(-40.0, 0.0, 0.0), reach),
            0.25 * wind.speedBound(Vec3(0.0, 0.0, 0.0), reach));
}

/// Returns a body that drives through random way points, to and fro, or around an orbit.
Primitive randomBody(const Random& random) {
  Primitive p = car();
  p.radius = random.uniform(0, 0.2, 2.0);
  p.inflow = random.uniform(1, -1.0, 1.0);
  p.plateau_length = random.uniform(2, 0.0, 20.0);
  p.decay_length = random.uniform(3, 1.0, 10.0);
  p.trajectory.clear();
  double t = 9.0, spread = random.uniform(4) < 0.3 ? 0.3 : 15.0;
  for (std::uint64_t i = 0; i < 6; ++i) {
    p.trajectory.push_back({at(t), Vec3(random.uniform(10 + 3 * i, -spread, spread),
                                        random.uniform(11 + 3 * i, -spread, spread), 1.0)});
    t += random.uniform(12 + 3 * i, 0.3, 3.0);
  }
  if (random.uniform(5) < 0.3) {
    p.trajectory.resize(1);
    p.orbit_radius = random.uniform(6, 0.1, 20.0);
    p.orbit_period = random.uniform(7, 2.0, 30.0);
  }
  return p;
}

/// Returns a point of the wake at this instant.
Vec3 placeIn(const Term& term, const Random& random) {
  const double s = random.uniform(0, -term.radius, term.plateau + term.decay);
  const double b = random.uniform(1, -1.0, 1.0) * WAKE_EDGE * stripOf(term).side * 0.3;
  const Vec3& n = term.direction;
  return term.centre - n * s + Vec3(-n.y(), n.x(), 0.0) * b;
}

// The bound at one stamp must hold up to a second before and after it, however the body turns,
// stops and starts.
TEST(Wake, IsBoundedWhereItComesWithinASecondThoughItsBodyTurns) {  // S1-22, S1-40
  int hit = 0;
  for (std::uint64_t c = 0; c < 20000; ++c) {
    const Random random = Random(11).child(c);
    const Field field({randomBody(random)});
    const double now = random.uniform(40, 9.0, 16.0), then = now + random.uniform(41, -1.0, 1.0);
    const Instant later = field.at(at(then));
    if (later.terms.empty()) continue;
    const Vec3 place = placeIn(later.terms[0], random.child(1));
    const double reach = random.uniform(42, 0.0, 3.0), turn = random.uniform(43, 0.0, 2.0 * PI);
    const Vec3 middle = place + Vec3(std::cos(turn), std::sin(turn), 0.0) * reach;
    const double speed = length(later.velocity(place));
    // Positions of 20 m lose 1e-14 m, which the steepest flank turns into less speed than this.
    ASSERT_LE(speed, field.at(at(now)).speedBound(middle, reach) + 1e-9) << "case " << c;
    if (speed > 0.01) ++hit;
  }
  EXPECT_GT(hit, 5000);
}

TEST(Wake, OfACircleIsNotBoundedFarFromIt) {
  Primitive p = car();
  p.plateau_length = p.decay_length = 5.0;
  p.trajectory = {{0, Vec3(0.0, 0.0, 1.0)}};
  p.orbit_radius = 20.0;
  p.orbit_period = 8.0 * PI;  // 5 m/s
  const Instant wind = Field({p}).at(0);
  EXPECT_EQ(wind.speedBound(Vec3(20.0, 9.0, 0.0), 1.0), 0.0);
  EXPECT_EQ(wind.speedBound(Vec3(20.0, -20.0, 0.0), 1.0), 0.0);
  EXPECT_EQ(wind.speedBound(Vec3(30.0, -5.0, 0.0), 1.0), 0.0);
  EXPECT_GT(wind.speedBound(Vec3(19.0, 4.0, 0.0), 0.0), 0.5);
}

TEST(Wake, OfAFasterBodyIsThatOfTheFastestAllowed) {
  Primitive p = car();
  // Within 200 m/s from way point to way point, the spline overshoots.
  p.trajectory = {{at(9.0), Vec3(0.0, 0.0, 1.0)},
                  {at(10.0), Vec3(0.0, 0.0, 1.0)},
                  {at(11.0), Vec3(200.0, 0.0, 1.0)}};
  const Instant wind = Field({p}).at(at(11.0));
  EXPECT_NEAR(length(wind.terms.at(0).amplitude), INFLOW * 200.0, 1e-9);
  EXPECT_NEAR(wind.terms.at(0).limit, INFLOW * 200.0 * WAKE_PEAK, 1e-9);
}

}  // namespace
}  // namespace vegetation_sim::wind
