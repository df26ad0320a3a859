// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/contact/contact_stepper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/integration/integrator.h"

namespace vegetation_sim::physics {
namespace {

// A twig of 0.5 m and 1 cm diameter, upright, and a wall that comes along x:
//
//   wall ->|   |
//          |   | twig
//          |   |
//              o
Link twig() {
  Link out;
  out.length = 0.5;
  out.mass = 0.035;
  out.centre = Vec3(0.0, 0.0, 0.25);
  const double across = out.mass * out.length * out.length / 3.0;
  out.inertia = {across, across, 1e-6, 0.0, 0.0, 0.0};
  out.stiffness = 8.0;
  out.damping = 0.02;
  return out;
}

/// Returns a link as long as the twig and far heavier.
Link trunkOf(double mass) {
  Link out = twig();
  out.mass = mass;
  out.inertia = {0.08 * mass, 0.08 * mass, 0.002 * mass, 0.0, 0.0, 0.0};
  return out;
}

struct Wall {
  double place{-0.05}, speed{0.0};  // [m], [m/s]
};

/// One twig and one wall that meets its tip.
class BodyOnBranch {
 public:
  explicit BodyOnBranch(const Link& link) : links_{link}, state_{{Vec2::Zero()}, {Vec2::Zero()}} {}

  void step(double h, Wall& wall) {
    kinematicsOf(links_, {}, state_, kinematics_);
    Contact contact;
    contact.along = links_[0].length;
    contact.normal = Vec3::UnitX();
    contact.gap = tip() - wall.place;
    contact.surface = wall.speed * Vec3::UnitX();
    contact.force = last_.force;
    contact.hardness = hardness;
    std::vector<Contact> contacts{contact};
    theta_ = guardedTheta(state_, h, theta_);
    stepper_.step(links_, {}, law, 0.0, h, theta_, state_, contacts);
    last_ = contacts[0];
    wall.place += h * wall.speed;
    kinematicsOf(links_, {}, state_, kinematics_);
  }
  double spin() const { return length(kinematics_.spin[0]); }
  double tip() const { return links_[0].length * axisZ(kinematics_.pose[0].orientation).x(); }
  const Contact& last() const { return last_; }
  const ContactStepper& stepper() const { return stepper_; }

  ContactLaw law;
  double hardness{1.0};

 private:
  std::vector<Link> links_;
  ChainState state_;
  Kinematics kinematics_;
  ContactStepper stepper_;
  Contact last_;
  double theta_{0.5};
};

// The twig bends until its spring balances the wall, and overlaps it by force / stiffness.
TEST(Contact, PressedTwigComesToRestWhereForcesBalance) {
  BodyOnBranch meeting(twig());
  Wall wall{-0.02, 0.2};
  const double h = 1.0 / 240.0;
  for (int i = 0; i < 144; ++i) meeting.step(h, wall);
  wall.speed = 0.0;
  for (int i = 0; i < 480; ++i) meeting.step(h, wall);
  const double angle = std::asin(meeting.tip() / 0.5);
  const double force = 8.0 * angle / (0.5 * std::cos(angle));
  EXPECT_NEAR(meeting.last().force, force, 1e-3 * force);
  EXPECT_NEAR(wall.place - meeting.tip(), force / meeting.law.stiffness, 1e-8);
}

// For stiffnesses thirty thousand times apart, at any step: the overlap is no deeper than the force
// requires (plus what a tip loses on its arc in a step), and the contact presses without a break
// but for a bounce or two of a few steps.
TEST(Contact, NeitherSinksInNorRingsAtAnySpeedStepAndStiffness) {
  for (const double speed : {0.1, 0.5, 1.0, 2.0, 3.0}) {
    for (const double h : {1e-3, 1.0 / 240.0, 1.0 / 60.0}) {
      for (const double stiffness : {1e5, 5e5, 1e8}) {
        BodyOnBranch meeting(twig());
        meeting.law.stiffness = stiffness;
        Wall wall{-0.051, speed};
        double deepest = 0.0, hardest = 0.0;
        int breaks = 0;
        bool touched = false;
        while (wall.place < 0.3) {
          meeting.step(h, wall);
          deepest = std::max(deepest, wall.place - meeting.tip());
          hardest = std::max(hardest, meeting.last().force);
          touched = touched || meeting.last().force > 0.0;
          breaks += touched && meeting.last().force == 0.0;
          ASSERT_TRUE(meeting.stepper().agreed());
        }
        const double arc = speed * speed * h * h / 0.5;
        EXPECT_LT(deepest, hardest / stiffness + arc + 1e-4)
            << speed << " m/s, " << h << " s, " << stiffness << " N/m";
        EXPECT_LE(breaks, 8) << speed << " m/s, " << h << " s, " << stiffness << " N/m";
        EXPECT_GT(hardest, 0.0);
      }
    }
  }
}

// A trunk resists with the limit and is overrun, at any step.
TEST(Contact, ForceIsLimited) {
  for (const double h : {1.0 / 240.0, 1.0 / 960.0, 1.0 / 3840.0}) {
    Link trunk = trunkOf(500.0);
    trunk.stiffness = 1e6;
    BodyOnBranch meeting(trunk);
    Wall wall{-0.02, 1.0};
    double hardest = 0.0;
    while (wall.place < 0.05) {
      meeting.step(h, wall);
      hardest = std::max(hardest, meeting.last().force);
    }
    EXPECT_EQ(hardest, meeting.law.force_limit) << h << " s";
    EXPECT_TRUE(meeting.last().limited) << h << " s";
    EXPECT_GT(wall.place - meeting.tip(), 0.045) << h << " s";
  }
}

// Continuous in time: halving the step halves how much the force can rise in one, where a slow wall
// meets wood that hardly yields. What would enter by a millimetre is stopped at once instead.
TEST(Contact, ForceRisesNoFasterThanTheLawWhereItMayTakeItsTime) {
  for (const double h : {1.0 / 240.0, 1.0 / 480.0, 1.0 / 960.0}) {
    BodyOnBranch meeting(trunkOf(50000.0));
    Wall wall{-0.001, 0.02};
    double before = 0.0, rise = 0.0;
    while (wall.place < 0.005) {
      meeting.step(h, wall);
      rise = std::max(rise, meeting.last().force - before);
      before = meeting.last().force;
    }
    EXPECT_LE(rise, meeting.law.force_rate * h + 1e-6);
    EXPECT_GT(before, 0.2 * meeting.law.force_limit) << "it never met the wall in earnest";
  }
}

// Continuous in time at any speed and depth, also with a body that is inside already: the force
// rises at the law's rate and by the spring for the deeper part, so half the step halves the rise.
TEST(Contact, ForceRisesByRateAndSpringHoweverDeep) {
  for (const double start : {-0.02, 0.02}) {
    for (const double speed : {0.0, 0.02, 0.1, 0.3, 1.0, 3.0}) {
      for (const double h : {1.0 / 240.0, 1.0 / 960.0, 1.0 / 3840.0}) {
        Link trunk = trunkOf(50000.0);
        trunk.stiffness = 1e6;
        BodyOnBranch meeting(trunk);
        Wall wall{start, speed};
        double before = 0.0, rise = 0.0, hardest = 0.0;
        for (double time = 0.0; time < 0.3 && (speed < 1.0 || wall.place < 0.05); time += h) {
          meeting.step(h, wall);
          rise = std::max(rise, meeting.last().force - before);
          before = meeting.last().force;
          hardest = std::max(hardest, before);
        }
        // A trunk that yields a little comes back: its own speed counts as the wall's.
        const double fastest = speed + 0.02;
        EXPECT_LE(rise, h * (meeting.law.force_rate + meeting.law.stiffness * fastest))
            << start << " m, " << speed << " m/s, " << h << " s";
        EXPECT_TRUE(start < 0.0 || hardest > 100.0) << hardest;
      }
    }
  }
}

// S1-W6. Harder wood: as many times the spring and the limit.
TEST(Contact, HarderWoodPressesHarder) {
  for (const double hardness : {1.0, 5.0}) {
    BodyOnBranch meeting(trunkOf(50000.0));
    meeting.hardness = hardness;
    Wall wall{-0.001, 0.02};
    while (wall.place < 0.001) meeting.step(1.0 / 960.0, wall);
    EXPECT_NEAR(meeting.last().force, hardness * 500.0, hardness * 25.0);
    wall.speed = 1.0;
    while (wall.place < 0.02) meeting.step(1.0 / 960.0, wall);
    EXPECT_EQ(meeting.last().force, hardness * meeting.law.force_limit);
  }
}

// Momentum: the angular momentum that the twig gains is the moment of the returned force, less its
// spring.
TEST(Contact, ReturnedForceIsTheOneOnTheTwig) {
  Link free = twig();
  free.stiffness = 0.0;
  free.damping = 0.0;
  for (const double h : {1.0 / 240.0, 1.0 / 3840.0}) {
    BodyOnBranch meeting(free);
    Wall wall{-0.01, 3.0};
    double published = 0.0;
    while (wall.place < 0.05) {
      meeting.step(h, wall);
      published += h * meeting.last().force * free.length;
    }
    EXPECT_GT(published, 0.0);
    EXPECT_NEAR(free.inertia.xx * meeting.spin(), published, 0.01 * published)
        << h << " s";  // on its arc
  }
}

// A contact whose force changes much in a step reports it; one that rests or is overrun does not.
TEST(Contact, ForceChangeShowsWhatAStepDoesNotResolve) {
  BodyOnBranch meeting(trunkOf(500.0));
  Wall wall{-0.02, 1.0};
  double before = 0.0, largest = 0.0;
  while (wall.place < 0.05) {
    meeting.step(1.0 / 960.0, wall);
    const double change = std::fabs(meeting.last().force - before);
    EXPECT_GE(meeting.stepper().forceChange(), change);
    largest = std::max(largest, change);
    before = meeting.last().force;
  }
  EXPECT_GT(largest, 500.0);
  EXPECT_TRUE(meeting.last().limited);
  EXPECT_EQ(meeting.stepper().forceChange(), 0.0);
  BodyOnBranch resting(twig());
  Wall still{0.0, 0.2};
  for (int i = 0; i < 480; ++i) {
    if (i == 20) still.speed = 0.0;
    resting.step(1.0 / 240.0, still);
  }
  EXPECT_GT(resting.last().force, 0.1);
  EXPECT_LT(resting.stepper().forceChange(), 0.1);
}

TEST(Contact, WhatWouldEnterDeeplyIsStoppedAtOnce) {
  BodyOnBranch meeting(trunkOf(500.0));
  Wall wall{-0.02, 3.0};
  while (meeting.last().force == 0.0) meeting.step(1.0 / 240.0, wall);
  EXPECT_EQ(meeting.last().force, meeting.law.force_limit);
}

// Continuous in time also where a body disappears: the force falls by the limit in 32 us.
TEST(Contact, ForceFallsNoFasterThanTheLimitIn32Microseconds) {
  for (const double hardness : {1.0, 5.0}) {
    for (const double h : {2e-6, 8e-6, 32e-6, 1.0 / 240.0}) {
      BodyOnBranch meeting(trunkOf(50000.0));
      meeting.hardness = hardness;
      Wall wall{-0.001, 0.5};
      while (meeting.last().force < hardness * 1500.0) meeting.step(1e-4, wall);
      wall = {-1.0, 0.0};
      double before = meeting.last().force, time = 0.0;
      for (const double first = before; before > 0.0; before = meeting.last().force) {
        meeting.step(h, wall);
        time += h;
        const double fall = std::min(before, h * meeting.law.force_limit / 32e-6);
        EXPECT_NEAR(before - meeting.last().force, fall, 1e-6) << first << " N, " << h << " s";
      }
      EXPECT_LT(time, h + 32e-6 * hardness);
    }
  }
}

TEST(Contact, NeverPulls) {
  BodyOnBranch meeting(twig());
  Wall wall{0.0, 0.5};
  for (int i = 0; i < 60; ++i) meeting.step(1.0 / 240.0, wall);
  wall.speed = -5.0;
  for (int i = 0; i < 240; ++i) {
    meeting.step(1.0 / 240.0, wall);
    EXPECT_GE(meeting.last().force, 0.0);
    EXPECT_GE(meeting.tip(), wall.place - 1e-6);
  }
  EXPECT_EQ(meeting.last().force, 0.0);
}

// An overlap that is there from the start is undone at the stated speed, not at once.
TEST(Contact, OverlapIsUndoneSlowly) {
  for (const double h : {1.0 / 240.0, 1.0 / 960.0}) {
    BodyOnBranch meeting(twig());
    Wall wall{0.1, 0.0};
    double before = 0.0, fastest = 0.0;
    for (double time = 0.0; time < 0.5; time += h) {
      meeting.step(h, wall);
      fastest = std::max(fastest, (meeting.tip() - before) / h);
      before = meeting.tip();
    }
    EXPECT_NEAR(fastest, meeting.law.push_speed, 0.02) << h << " s";
    EXPECT_NEAR(meeting.tip(), 0.1, 1e-3) << h << " s";
  }
}

// Three links between walls on both sides: all contacts agree in the end, and no wall is entered.
TEST(Contact, ContactsOnBothSidesAgree) {
  std::vector<Link> links{twig(), twig(), twig()};
  links[1].parent = 0, links[1].h = 0.5;
  links[2].parent = 1, links[2].h = 0.5;
  ChainState state{std::vector<Vec2>(3, Vec2::Zero()), std::vector<Vec2>(3, Vec2::Zero())};
  Kinematics k;
  ContactStepper stepper;
  std::vector<double> force(6, 0.0);
  const double h = 1.0 / 240.0;
  double deepest = 0.0;
  for (int n = 0; n < 480; ++n) {
    const double half = std::max(0.01, 0.06 - 0.1 * n * h), shift = 0.1 * std::sin(6.0 * n * h);
    kinematicsOf(links, {}, state, k);
    std::vector<Contact> contacts;
    for (int link = 0; link < 3; ++link) {
      for (const double side : {-1.0, 1.0}) {
        Contact c;
        c.link = link;
        c.along = 0.5;
        const auto i = static_cast<std::size_t>(link);
        c.normal = -side * Vec3::UnitX();
        const double x = k.pose[i].position.x() + 0.5 * axisZ(k.pose[i].orientation).x();
        c.gap = half - side * (x - shift);
        c.surface = Vec3(0.6 * std::cos(6.0 * n * h) - (half > 0.01 ? side * 0.1 : 0.0), 0.0, 0.0);
        c.force = force[contacts.size()];
        deepest = std::max(deepest, -c.gap);
        contacts.push_back(c);
      }
    }
    stepper.step(links, {}, ContactLaw(), 0.0, h, 1.0, state, contacts);
    ASSERT_TRUE(stepper.agreed());
    EXPECT_LE(stepper.trials(), 8);
    for (std::size_t c = 0; c < 6; ++c) force[c] = contacts[c].force;
  }
  EXPECT_LT(deepest, 1e-3);
}

}  // namespace
}  // namespace vegetation_sim::physics
