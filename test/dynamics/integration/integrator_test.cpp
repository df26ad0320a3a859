// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/integration/integrator.h"

#include <gtest/gtest.h>

#include "scenes/dynamics/chain_scene.h"

namespace vegetation_sim::physics {
namespace {

std::vector<Vec3> tipsAfter(Integrator integrator, double seconds, int steps, double strength) {
  Simulation run{crown(31, 0.1), integrator};
  const Surroundings outside = gust(run.links, strength);
  const double h = seconds / steps;
  for (int i = 0; i < steps; ++i) run.step(outside, i * h, h);
  return run.tips();
}

// The default's error is quadratic in the step, against converged Runge-Kutta.
TEST(Integrator, MidpointIsSecondOrder) {
  const auto reference = tipsAfter(Integrator::RUNGE_KUTTA_4, 0.5, 8192, 3.0);
  const double coarse = rms(tipsAfter(Integrator::MIDPOINT, 0.5, 512, 3.0), reference);
  const double fine = rms(tipsAfter(Integrator::MIDPOINT, 0.5, 1024, 3.0), reference);
  EXPECT_GT(coarse, 1e-8);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

TEST(Integrator, ImplicitEulerIsFirstOrder) {
  const auto reference = tipsAfter(Integrator::RUNGE_KUTTA_4, 0.5, 8192, 3.0);
  const double coarse = rms(tipsAfter(Integrator::IMPLICIT_EULER, 0.5, 1024, 3.0), reference);
  const double fine = rms(tipsAfter(Integrator::IMPLICIT_EULER, 0.5, 2048, 3.0), reference);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 0.15);
}

// Holds the tip of the last link by a spring whose other end moves.
Surroundings holdTip(const std::vector<Link>& links, const Vec3& from, double stiffness,
                     double damping) {
  Surroundings out;
  out.loads = [&links, from, stiffness, damping](const Kinematics& k, double t, Loads& loads) {
    const std::size_t i = links.size() - 1;
    Anchor anchor;
    anchor.link = static_cast<int>(i);
    anchor.arm = links[i].length * axisZ(k.pose[i].orientation);
    const Vec3 pull(0.4, 0.2, -0.1);
    const double s = std::sin(3.0 * t);
    const Vec3 point = k.pose[i].position + anchor.arm;
    const Vec3 velocity = k.velocity[i] + cross(k.spin[i], anchor.arm);
    anchor.force = stiffness * (from + s * s * pull - point) +
                   damping * (6.0 * s * std::cos(3.0 * t) * pull - velocity);
    anchor.stiffness = {stiffness, stiffness, stiffness, 0.0, 0.0, 0.0};
    anchor.damping = {damping, damping, damping, 0.0, 0.0, 0.0};
    loads.anchors.push_back(anchor);
  };
  return out;
}

std::vector<Vec3> heldTips(Integrator integrator, int steps) {
  Simulation run{crown(15, 0.1), integrator};
  const Surroundings outside = holdTip(run.links, run.tips().back(), 200.0, 2.0);
  for (int i = 0; i < steps; ++i) run.step(outside, i * 0.5 / steps, 0.5 / steps);
  return run.tips();
}

// S1-27: second order holds with a spring at a point, whose force moves the whole tree.
TEST(Integrator, MidpointIsSecondOrderWithAnAnchor) {
  const auto reference = heldTips(Integrator::RUNGE_KUTTA_4, 8192);
  const double coarse = rms(heldTips(Integrator::MIDPOINT, 512), reference);
  const double fine = rms(heldTips(Integrator::MIDPOINT, 1024), reference);
  EXPECT_GT(coarse, 1e-8);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15);
}

std::vector<Vec3> draggedTips(Integrator integrator, bool quadratic, int steps) {
  Simulation run{crown(31, 0.02), integrator};
  const Surroundings outside =
      quadratic ? quadraticGust(run.links, 8.0) : gustAndPull(run.links, 8.0, 0.0);
  for (int i = 0; i < steps; ++i) run.step(outside, i * 0.5 / steps, 0.5 / steps);
  return run.tips();
}

// S1-27: drag depends on rates, which are known before the step; the implicit part makes it second
// order.
TEST(Integrator, MidpointIsSecondOrderInDrag) {
  for (const bool quadratic : {false, true}) {
    const auto reference = draggedTips(Integrator::RUNGE_KUTTA_4, quadratic, 8192);
    const double coarse = rms(draggedTips(Integrator::MIDPOINT, quadratic, 512), reference);
    const double fine = rms(draggedTips(Integrator::MIDPOINT, quadratic, 1024), reference);
    EXPECT_GT(coarse, 1e-8);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.15) << quadratic;
  }
}

// The drag of a leaf on a twig of a gram would grow without bound at the rates before the step.
TEST(Integrator, StrongDragOnLightWoodOnlyBrakes) {
  Simulation run{crown(63, 0.02)};
  const Surroundings outside = gustAndPull(run.links, 0.0, 0.0);
  const Surroundings strong{{}, [&](const Kinematics& k, double t, Loads& loads) {
                              outside.loads(k, t, loads);
                              for (std::size_t i = 0; i < run.links.size(); ++i) {
                                const double more = 300.0;  // times bare wood's
                                loads.wrench[i].force *= more;
                                loads.wrench[i].torque *= more;
                                loads.drag[i].all *= more;
                              }
                            }};
  run.state = randomState(run.links.size(), 0.05, 0.5, 3);
  const double start = energyOf(run.links, run.state, kinematicsAt(run.links, run.state));
  for (int i = 0; i < 240; ++i) run.step(strong, i / 60.0, 1.0 / 60.0);
  EXPECT_LT(energyOf(run.links, run.state, kinematicsAt(run.links, run.state)), 1e-2 * start);
}

// A gripper's spring of 5 kN/m on a twig of a gram: explicitly unstable above 2 sqrt(m / k) = 1 ms.
TEST(Integrator, StiffAnchorOnATwigHoldsAtTheTick) {
  Simulation run{crown(255, 0.1)};
  const Vec3 from = run.tips().back();
  ASSERT_LT(run.links.back().mass, 0.02);
  const Surroundings outside = holdTip(run.links, from, 5000.0, 20.0);
  const double h = 1.0 / 240.0;
  double worst = 0.0;
  for (int i = 0; i < 720; ++i) {
    run.step(outside, i * h, h);
    const double s = std::sin(3.0 * (i + 1) * h);
    const Vec3 target = from + s * s * Vec3(0.4, 0.2, -0.1);
    if (i > 60) worst = std::max(worst, (run.tips().back() - target).norm());
  }
  EXPECT_LT(worst, 0.05);  // the branch pulls back with up to 250 N
}

// One joint: stiffness w^2, damping c, unit inertia.
std::vector<Link> oneJoint(double w, double c) {
  Link link;
  link.mass = 3.0;
  link.stiffness = w * w;
  link.damping = c;
  return {link};
}

bool staysBounded(Integrator integrator, double w, double c, double h) {
  Simulation run{oneJoint(w, c), integrator};
  run.state.q[0].x() = 1e-5;
  for (int i = 0; i < 500000 && run.state.q[0].norm() > 1e-12; ++i) {
    run.step({}, 0.0, h);
    if (!(std::fabs(run.state.q[0].x()) < 1e-3)) return false;
  }
  return true;
}

// S1-W4: implicit methods are stable at a hundred times the explicit bound and far beyond.
TEST(Integrator, ImplicitMethodsHoldAtAnyStep) {
  for (const Integrator integrator : {Integrator::MIDPOINT, Integrator::IMPLICIT_EULER})
    for (const double w : {1.0, 50.0, 1e4})
      for (const double h : {1e-4, 1e-2, 0.1, 1.0})
        EXPECT_TRUE(staysBounded(integrator, w, 0.1 * w, h)) << w << " " << h;
}

double staticTip(int n, double force) {
  Simulation run{beam(n, 2.0, 0.02, 8e9, 900.0), Integrator::IMPLICIT_EULER};
  // A static load is found by letting a heavily damped beam settle in large implicit steps.
  for (Link& link : run.links) link.damping = 0.05 * link.stiffness;
  Surroundings pull;
  pull.loads = [&](const Kinematics& k, double, Loads& loads) {
    Wrench& load = loads.wrench.back();
    load.force = Vec3(force, 0, 0);
    load.torque = cross(run.links.back().length * axisZ(k.pose.back().orientation), load.force);
  };
  for (int i = 0; i < 400; ++i) run.step(pull, 0.0, 0.05);
  return run.tips().back().x();
}

// S1-28, E13: deflection of a cantilever against beam theory, F L^3 / (3 E I); the error falls with
// the square of the number of pieces.
TEST(Integrator, CantileverBendsAsABeam) {
  const double inertia = M_PI * std::pow(0.02, 4) / 4.0;
  const double theory = 8.0 / (3.0 * 8e9 * inertia);
  const double coarse = std::fabs(staticTip(8, 1.0) / theory - 1.0);
  const double fine = std::fabs(staticTip(16, 1.0) / theory - 1.0);
  EXPECT_LT(fine, 0.003);
  EXPECT_NEAR(coarse / fine, 4.0, 0.6);
}

// Gravity on a soft beam: at rest each joint's spring carries the weight beyond it.
TEST(Integrator, GravityFindsItsEquilibrium) {
  Simulation run{beam(6, 1.0, 0.004, 8e9, 900.0)};
  run.links[0].rest = {std::cos(0.5), 0.0, std::sin(0.5), 0.0};
  for (Link& link : run.links) link.damping = 0.05 * link.stiffness;
  const Vec3 gravity(0.0, 0.0, -9.81);
  Surroundings outside;
  outside.loads = [&](const Kinematics& k, double, Loads& loads) {
    for (std::size_t i = 0; i < run.links.size(); ++i) {
      loads.wrench[i].force = run.links[i].mass * gravity;
      loads.wrench[i].torque =
          cross(rotate(k.pose[i].orientation, run.links[i].centre), loads.wrench[i].force);
    }
  };
  for (int i = 0; i < 8000; ++i) run.step(outside, 0.0, 1.0 / 240.0);
  const Kinematics k = kinematicsAt(run.links, run.state);
  for (std::size_t i = 0; i < run.links.size(); ++i) {
    Vec3 torque = Vec3::Zero();
    for (std::size_t j = i; j < run.links.size(); ++j) {
      const Vec3 centre = k.pose[j].position + rotate(k.pose[j].orientation, run.links[j].centre);
      torque += cross(centre - k.pose[i].position, run.links[j].mass * gravity);
    }
    const Vec3 own = rotate(conjugate(k.pose[i].orientation), torque);
    EXPECT_NEAR(run.links[i].stiffness * run.state.q[i].y(), own.y(), 1e-6) << i;
  }
}

// Energy is conserved by the reference without damping, and only lost with it, by any method.
TEST(Integrator, EnergyIsConservedAndDamped) {
  for (const double ratio : {0.0, 0.1}) {
    Simulation run{crown(31, ratio), Integrator::RUNGE_KUTTA_4};
    for (Vec2& q : run.state.q) q = Vec2(0.02, -0.01);
    const auto energy = [&] {
      return energyOf(run.links, run.state, kinematicsAt(run.links, run.state));
    };
    const double start = energy();
    double before = start;
    for (int i = 0; i < 400; ++i) {
      run.step({}, 0.0, 1e-4);
      EXPECT_LE(energy(), before * (1.0 + 1e-9));
      before = energy();
    }
    if (ratio == 0.0) {
      EXPECT_NEAR(before / start, 1.0, 1e-6);
    } else {
      EXPECT_LT(before / start, 0.9);
    }
  }
}

double energyIn(const Simulation& run) {
  return energyOf(run.links, run.state, kinematicsAt(run.links, run.state));
}

/// Largest and last energy of a run without loads, over that at the start.
struct Energies {
  double most{0.0}, last{0.0}, theta{0.5};
};

Energies energiesOf(Simulation run, const Vec2& bend, double h, double seconds) {
  for (Vec2& q : run.state.q) q = bend;
  const double start = energyIn(run);
  const int steps = static_cast<int>(seconds / h + 0.5);
  Energies out;
  for (int i = 0; i < steps; ++i) {
    run.step({}, 0.0, h);
    out.last = energyIn(run) / start;
    out.most = std::max(out.most, out.last);
    out.theta = std::max(out.theta, run.theta);
  }
  return out;
}

// Ten seconds at the tick without dampers, in which the stiffest twigs oscillate many times per
// tick. Rates and bends are half a step out of phase there, so that their energy ripples.
TEST(Integrator, MidpointKeepsTheEnergyOfAnUndampedTree) {
  const Energies small = energiesOf({crown(127, 0.0)}, Vec2(0.02, -0.01), 1.0 / 240.0, 10.0);
  EXPECT_EQ(small.theta, 0.5);
  EXPECT_LT(small.most, 1.08);
  EXPECT_NEAR(small.last, 1.0, 0.05);
  const Energies large = energiesOf({crown(127, 0.0)}, Vec2(0.3, -0.15), 1.0 / 240.0, 10.0);
  EXPECT_EQ(large.theta, 1.0);  // the guard takes energy out
  EXPECT_LT(large.most, 1.1);
  EXPECT_LT(large.last, 0.5);
}

// The energy error is quadratic in the step.
TEST(Integrator, EnergyErrorIsSecondOrder) {
  const auto error = [](double h) {
    const Energies out = energiesOf({crown(31, 0.0)}, Vec2(0.1, -0.05), h, 0.5);
    EXPECT_EQ(out.theta, 0.5);
    return out.last - 1.0;
  };
  const double coarse = error(0.5 / 2048), fine = error(0.5 / 4096);
  EXPECT_GT(std::fabs(coarse), 1e-7);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

// The default gains no energy without input: a tree is released at large bends, at the tick; the
// first steps ripple.
TEST(Integrator, MidpointGainsNoEnergy) {
  const Energies out = energiesOf({crown(63, 0.02)}, Vec2(0.3, -0.2), 1.0 / 240.0, 10.0);
  EXPECT_LT(out.most, 1.05);
  EXPECT_LT(out.last, 0.01);
}

// S1-W4, S1-42: with stiffness 1e6 apart in one tree, a storm of thirty times the gust leaves it
// bounded at every step from 0.1 to 50 ms, and it comes back to rest; the guard acts there and not
// in normal use.
TEST(Integrator, GuardedMidpointSurvivesAStorm) {
  std::vector<Link> links = crown(63, 0.1);
  double stiffest = 0.0, softest = 1e30;
  for (const Link& link : links) {
    stiffest = std::max(stiffest, link.stiffness);
    softest = std::min(softest, link.stiffness);
  }
  for (Link& link : links)
    link.stiffness *= link.stiffness > 0.5 * stiffest ? softest * 1e6 / stiffest : 1.0;
  for (const double h : {1e-4, 1e-3, 1.0 / 240, 1.0 / 60, 0.05}) {
    Simulation run{links};
    const Surroundings storm = gust(run.links, 30.0 * 20.0);
    double largest = 0.0, theta = 0.5;
    const int steps = static_cast<int>((h < 1e-3 ? 1.5 : 12.0) / h);
    for (int i = 0; i < steps; ++i) {
      run.step(storm, i * h, h);
      theta = std::max(theta, run.theta);
      for (const Vec2& q : run.state.q) largest = std::max(largest, q.norm());
    }
    EXPECT_LT(largest, 20.0) << h;
    for (const Vec2& q : run.state.q) EXPECT_TRUE(h < 1e-3 || q.norm() < 0.05) << h;
    if (h > 0.01) {
      EXPECT_EQ(theta, 1.0) << h;
    }
  }
  Simulation calm{crown(63, 0.1)};
  const Surroundings breeze = gust(calm.links, 0.5);
  for (int i = 0; i < 240; ++i) {
    calm.step(breeze, i / 240.0, 1.0 / 240);
    EXPECT_EQ(calm.theta, 0.5);
  }
}

// S1-W4: far beyond: wood a hundred million times as stiff at the root as at the twigs, under six
// hundred newtons a metre that nothing damps, at steps up to half a second. Joints reach their
// stops and stay finite.
TEST(Integrator, StopsHoldInAnyStorm) {
  std::vector<Link> links = crown(127, 0.1);
  spreadStiffness(links, 1e8);
  const Surroundings storm = gust(links, 600.0);
  for (const double h : {1e-4, 1e-3, 1.0 / 60, 0.05, 0.5}) {
    Simulation run{links};
    double farthest = 0.0;
    for (int i = 0; i < 1500; ++i) {
      run.stepper.step(run.integrator, links, storm, i * h, h, run.state, run.theta);
      for (std::size_t j = 0; j < links.size(); ++j) {
        ASSERT_LE(run.state.q[j].norm(), LARGEST_BEND + 1e-9) << h;
        ASSERT_LE(run.state.rate[j].norm() * h, LARGEST_TURN + 1e-9) << h;
        farthest = std::max(farthest, run.state.q[j].norm());
      }
    }
    EXPECT_GT(farthest, 2.9) << h;
  }
}

}  // namespace
}  // namespace vegetation_sim::physics
