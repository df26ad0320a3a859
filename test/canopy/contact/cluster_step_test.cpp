// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/contact/cluster_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::canopy {
namespace {

/// One cell of 0.2 m, 1 m high, at the origin.
Fibres oneCell() {
  Fibres out;
  out.length = 1.0;
  out.half = 0.1;
  return out;
}

double areaOf(const Fibres& fibres) {
  return 4.0 * fibres.half * fibres.half * filledShare(fibres, 0);
}

/// A wall whose face is at x and pushes to +x.
PosedBody wallTo(double x, double speed = 0.0) {
  PosedBody out;
  out.shape = {Vec3(5.0, 5.0, 5.0), 0.0};
  out.pose.position = Vec3(x - 5.0, 0.0, 0.0);
  out.velocity = Vec3(speed, 0.0, 0.0);
  return out;
}

/// A small ball at a height, with its centre at x.
PosedBody ballAt(double x, double z, double speed = 0.0) {
  PosedBody out;
  out.shape = {Vec3::Zero(), 0.05};
  out.pose.position = Vec3(x, 0.0, z);
  out.velocity = Vec3(speed, 0.0, 0.0);
  return out;
}

// The damped oscillator's own solution, at any step and damping.
TEST(ClusterStep, SwingsAsTheDampedOscillatorDoes) {
  for (const double damping : {0.0, 0.3, 1.0, 4.0})
    for (const double dt : {0.001, 0.05, 3.0}) {
      PushLaw law;
      law.damping = damping;
      const double omega = 2.0 * PI * law.frequency;
      Cluster cluster;
      cluster.lean = {0.3, -0.1};
      const double at = 0.6;  // [s]
      const int steps = dt > at ? 1 : static_cast<int>(std::lround(at / dt));
      const double time = dt > at ? dt : at;
      for (int i = 0; i < steps; ++i) swing(law, dt, cluster);
      double expected;
      if (damping < 1.0) {
        const double turn = omega * std::sqrt(1.0 - damping * damping);
        expected = std::exp(-damping * omega * time) *
                   (std::cos(turn * time) + damping * omega / turn * std::sin(turn * time));
      } else if (damping == 1.0) {
        expected = std::exp(-omega * time) * (1.0 + omega * time);
      } else {
        const double root = std::sqrt(damping * damping - 1.0);
        const double fast = -omega * (damping + root), slow = -omega * (damping - root);
        expected = (fast * std::exp(slow * time) - slow * std::exp(fast * time)) / (fast - slow);
      }
      // Below 2e-5 rad the cell rests.
      EXPECT_NEAR(cluster.lean.x, 0.3 * expected, 1e-12 + (std::fabs(expected) < 1e-3 ? 2e-5 : 0.0))
          << damping << " " << dt;
      EXPECT_NEAR(cluster.lean.y, -0.1 * expected,
                  1e-12 + (std::fabs(expected) < 1e-3 ? 2e-5 : 0.0));
    }
}

// At rest the force at the height of the ball, times that over the length of the fibres, is the
// stiffness times the displacement of the tops; and the force is the pressure of the overlap.
TEST(ClusterStep, LeansUnderAForceByTheForceOverTheStiffness) {
  const PushLaw law;
  const Fibres fibres = oneCell();
  for (const double height : {0.3, 0.9}) {
    const std::vector<PosedBody> bodies{ballAt(-0.08, height)};
    Cluster cluster;
    BodyLoad load;
    for (int i = 0; i < 20000; ++i) {
      std::vector<BodyLoad> loads(1);
      stepCluster(law, fibres, 0, 0.01, bodies, cluster, loads);
      load = loads[0];
    }
    EXPECT_GT(cluster.lean.x, 0.01);
    EXPECT_NEAR(cluster.lean.y, 0.0, 1e-12);
    const Vec3 force = load.impulse / 0.01;
    // Torque of the force about the foot.
    const Vec3 lever = load.moment / 0.01 + cross(bodies[0].pose.position, force);
    const double torque = -lever.y();
    EXPECT_NEAR(torque, areaOf(fibres) * law.stiffness * cluster.lean.x, 1e-6 * torque) << height;
    // Normals of the ball differ by a quarter of a radian from their mean.
    EXPECT_NEAR(length(force), law.pressure * load.volume / 0.01, 0.04 * length(force));
  }
}

TEST(ClusterStep, AWallPressesByPressureTimesOverlap) {
  PushLaw law;
  law.stiffness = 1e6;  // it hardly gives way
  law.drag = 0.0;
  const Fibres fibres = oneCell();
  Cluster cluster;
  std::vector<BodyLoad> loads(1);
  // The wall enters the cell, whose edge is at -0.1, by 2 cm.
  for (int i = 0; i < 2000; ++i) {
    loads.assign(1, {});
    stepCluster(law, fibres, 0, 0.01, {wallTo(-0.08)}, cluster, loads);
  }
  // Depth times height times pressure, on the share of the edge that the circle fills.
  const double area = areaOf(fibres) / (2.0 * fibres.half);
  const double expected = law.pressure * 0.02 * area * fibres.length;
  EXPECT_NEAR(-loads[0].impulse.x() / 0.01, expected, 0.05 * expected);
  EXPECT_NEAR(loads[0].volume / 0.01, 0.02 * area * fibres.length, 0.05 * 0.02 * area);
}

// Resistance of the overlap to motion along the surface.
TEST(ClusterStep, DragIsProportionalToOverlapAndSpeed) {
  PushLaw law;
  law.stiffness = 1e6;
  law.pressure = 0.0;
  const Fibres fibres = oneCell();
  double before = 0.0;
  for (const double speed : {0.5, 1.0}) {
    Cluster cluster;
    PosedBody wall = wallTo(-0.05);
    wall.velocity = Vec3(0.0, speed, 0.0);
    std::vector<BodyLoad> loads(1);
    for (int i = 0; i < 500; ++i) {
      loads.assign(1, {});
      stepCluster(law, fibres, 0, 0.01, {wall}, cluster, loads);
    }
    const double force = -loads[0].impulse.y() / 0.01, volume = loads[0].volume / 0.01;
    EXPECT_NEAR(force, law.drag * volume * speed, 0.01 * force);
    EXPECT_NEAR(force, before > 0.0 ? 2.0 * before : force, 0.01 * force);
    before = force;
  }
}

// An explicit step would be unstable beyond dt omega = 2, omega of the fibres on the medium. This
// one has no limit: on both sides of it the fibres come to the same rest, without growing swings.
TEST(ClusterStep, IsStableBeyondTheLimitOfAnExplicitStep) {
  PushLaw law;
  law.damping = 1.0;
  law.drag = 0.0;
  const Fibres fibres = oneCell();
  for (const double pressure : {1e4, 1e6}) {
    law.pressure = pressure;
    const double inertia = law.stiffness / std::pow(2.0 * PI * law.frequency, 2);
    const double omega = std::sqrt(pressure * fibres.length / (2.0 * fibres.half) / 3.0 / inertia);
    double finest = 0.0;
    for (const double step : {0.5, 1.9, 2.1, 20.0, 2000.0}) {
      Cluster cluster;
      const int steps = static_cast<int>(std::max(100.0, 20.0 * omega / step));
      for (int i = 0; i < steps; ++i) {
        std::vector<BodyLoad> loads(1);
        stepCluster(law, fibres, 0, step / omega, {wallTo(-0.08)}, cluster, loads);
      }
      if (step == 0.5) finest = cluster.lean.x;
      EXPECT_GT(cluster.lean.x, 0.01);
      EXPECT_NEAR(cluster.lean.x, finest, 1e-6) << pressure << " " << step;
      EXPECT_LT(cluster.rate.size(), 1e-6) << pressure << " " << step;
    }
  }
}

// A fast drive through the cell: the fibres never have more energy than the body has given them.
TEST(ClusterStep, NeverGainsMoreEnergyThanTheBodyGives) {
  for (const double damping : {0.0, 0.4})
    for (const double drag : {0.0, 2000.0})
      for (const double speed : {0.2, 1.0, 3.0}) {
        PushLaw law;
        law.damping = damping;
        law.drag = drag;
        const Fibres fibres = oneCell();
        const double dt = 0.01 / speed;
        Cluster cluster;
        double given = 0.0, most = 0.0;
        for (double x = -0.5; x < 3.0; x += 0.01) {
          std::vector<BodyLoad> loads(1);
          PosedBody box = ballAt(x, 0.4, speed);
          box.shape = {Vec3(0.15, 0.15, 0.15), 0.0};
          stepCluster(law, fibres, 0, dt, {box}, cluster, loads);
          given -= dot(loads[0].impulse, box.velocity);
          most = std::max(most, energyOf(law, fibres, 0, cluster));
          EXPECT_LE(energyOf(law, fibres, 0, cluster), given + 1e-9) << x << " " << speed;
        }
        EXPECT_GT(most, 0.01);
        EXPECT_LT(energyOf(law, fibres, 0, cluster), most);
      }
}

// The fibre keeps its length, and turns under a body that passes over it.
TEST(ClusterStep, LiesUnderABodyThatPassesOverIt) {
  PushLaw law;
  const Fibres fibres = oneCell();
  Cluster cluster;
  double largest = 0.0;
  for (double x = -1.0; x < 3.0; x += 0.005) {
    std::vector<BodyLoad> loads(1);
    PosedBody box = ballAt(x, 0.5, 0.5);
    box.shape = {Vec3(0.5, 0.5, 0.3), 0.0};  // 0.2 m above the ground
    stepCluster(law, fibres, 0, 0.01, {box}, cluster, loads);
    largest = std::max(largest, cluster.lean.x);
    EXPECT_LE(cluster.lean.size(), LARGEST_LEAN + 1e-12);
  }
  EXPECT_GT(largest, 1.0);
  for (int i = 0; i < 100; ++i) swing(law, 0.1, cluster);
  EXPECT_TRUE(cluster.rests());
}

// Grass-like recovery: a share of the largest lean remains, and disappears with its time constant.
TEST(ClusterStep, KeepsAShareOfItsLeanUntilItRecovers) {
  PushLaw law;
  law.set = 0.5;
  law.recovery = 20.0;
  law.damping = 1.0;
  Cluster cluster;
  cluster.lean = {0.8, 0.0};
  swing(law, 1e-6, cluster);
  EXPECT_NEAR(cluster.set.x, 0.4, 1e-6);
  for (int i = 0; i < 300; ++i) swing(law, 0.1, cluster);
  EXPECT_NEAR(cluster.lean.x, 0.4 * std::exp(-30.0 / 20.0), 2e-3);
  for (int i = 0; i < 3000; ++i) swing(law, 0.1, cluster);
  EXPECT_TRUE(cluster.rests());
}

}  // namespace
}  // namespace vegetation_sim::canopy
