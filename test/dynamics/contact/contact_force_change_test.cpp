// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "dynamics/contact/contact_stepper.h"

namespace vegetation_sim::physics {
namespace {

// A post that bears another. Two bodies are driven at both: the first body's contacts are on the
// lower and the upper one, then the second's is on the lower.
TEST(ContactForceChange, OfALinkSumsAllBodies) {
  Link post;
  post.length = 0.5;
  post.mass = 100.0;
  post.centre = Vec3(0.0, 0.0, 0.25);
  post.inertia = {8.0, 8.0, 0.2, 0.0, 0.0, 0.0};
  post.stiffness = 1e4;
  std::vector<Link> links{post, post};
  links[1].parent = 0, links[1].h = 0.5;
  ChainState state{std::vector<Vec2>(2, Vec2::Zero()), std::vector<Vec2>(2, Vec2::Zero())};
  std::vector<Contact> contacts(3);
  contacts[1].link = 1;
  for (Contact& contact : contacts) {
    contact.along = 0.3;
    contact.normal = Vec3::UnitX();
    contact.surface = Vec3::UnitX();
  }
  contacts[1].gap = 1e-3;  // met later, so less hard
  ContactStepper stepper;
  stepper.step(links, {}, ContactLaw(), 0.0, 5e-4, 0.5, state, contacts);
  ASSERT_TRUE(stepper.agreed());
  EXPECT_GT(contacts[0].force, 40.0);
  EXPECT_GT(contacts[2].force, 40.0);
  EXPECT_GE(stepper.forceChange(), contacts[0].force + contacts[2].force - 1e-9);
}

}  // namespace
}  // namespace vegetation_sim::physics
