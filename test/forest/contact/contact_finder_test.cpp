// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/contact/contact_finder.h"

#include <gtest/gtest.h>

#include "vegetation_sim/dynamics/chain/chain.h"
#include "vegetation_sim/tree/growth/skeleton.h"

namespace vegetation_sim::forest {
namespace {

constexpr Nanoseconds STEP = NANOSECONDS_PER_SECOND / 240;

/// One upright twig of 1 m and 1 cm diameter at the origin of its tree, and one level capsule of
/// 4 cm diameter along y, at half its height.
class ContactFinderTest : public testing::Test {
 protected:
  ContactFinderTest() {
    Branch twig;
    twig.length = 1.0;
    twig.base_radius = twig.tip_radius = 0.005;
    skeleton_.branches = {twig};
    kinematics_ = {{Pose()}, {Vec3(Vec3::Zero())}, {Vec3(Vec3::Zero())}};
    body_.id = "arm";
    body_.frame = "hand";
    body_.shape = Shape::CAPSULE;
    body_.size = Vec3(0.02, 0.0, 0.5);
    body_.pose.orientation = Quat{std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0};
    place(-0.5);
  }
  void place(double x) { body_.pose.position = FOOT + Vec3(x, 0.0, 0.5); }
  std::vector<physics::Contact> find() {
    return finder_.findContacts(contactTree(), {{body_.id, body_}}, 0, STEP, persistent_);
  }
  ContactTree contactTree() const { return {3, FOOT, branches_, skeleton_, kinematics_}; }

  const Vec3 FOOT{100.0, 50.0, 2.0};
  Skeleton skeleton_;
  physics::Kinematics kinematics_;
  std::vector<int> branches_{0};
  Body body_;
  PersistentContacts persistent_;
  ContactFinder finder_;
};

TEST_F(ContactFinderTest, FarBodyTouchesNothing) {
  EXPECT_TRUE(find().empty());
  EXPECT_TRUE(persistent_.empty());
}

TEST_F(ContactFinderTest, OverlapHasNormalAndVelocity) {
  place(-0.02);
  body_.velocity = Vec3(0.5, 0.0, 0.0);
  const auto contacts = find();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].link, 0);
  EXPECT_NEAR(contacts[0].along, 0.5, 1e-3);
  EXPECT_NEAR(length(contacts[0].normal - Vec3::UnitX()), 0.0, 1e-3);
  EXPECT_NEAR(contacts[0].gap, -0.005, 1e-6);
  EXPECT_EQ(contacts[0].surface, Vec3(0.5, 0.0, 0.0));
  EXPECT_EQ(contacts[0].share, 1.0);
}

// S1-W6: with one contact it would rotate about it into the body.
TEST_F(ContactFinderTest, TwigThatLiesFlatTouchesAtTwoPlaces) {
  body_.pose.orientation = Quat();
  place(-0.02);
  auto contacts = find();
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_GT(std::fabs(contacts[1].along - contacts[0].along), 0.2);
  for (physics::Contact& contact : contacts) {
    EXPECT_NEAR(contact.gap, -0.005, 2e-4);  // the farther one is slightly on the cap
    EXPECT_EQ(contact.force, 0.0);
    contact.force = 100.0 * contact.along;
  }
  std::vector<Reaction> reactions;
  finder_.recordForces(contactTree(), {{body_.id, body_}}, contacts, STEP, persistent_, reactions);
  EXPECT_EQ(reactions.size(), 2u);
  contacts = find();  // each has its own force again
  ASSERT_EQ(contacts.size(), 2u);
  for (const physics::Contact& contact : contacts)
    EXPECT_NEAR(contact.force, 100.0 * contact.along, 1e-6);
  const double both = contacts[0].force + contacts[1].force;
  body_.pose.orientation = Quat{std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0};
  contacts = find();  // crosswise: one contact with the force of both
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].force, both, 1e-9);
}

// 30 m/s: the body jumps over the twig within the step.
TEST_F(ContactFinderTest, FastBodyMeetsWhatItWouldJumpOver) {
  place(-0.06);
  EXPECT_TRUE(find().empty());
  body_.velocity = Vec3(30.0, 0.0, 0.0);
  const auto contacts = find();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(length(contacts[0].normal - Vec3::UnitX()), 0.0, 1e-3);
  EXPECT_NEAR(contacts[0].gap, 0.035, 1e-4);
}

TEST_F(ContactFinderTest, FastTwigMeetsWhatItWouldJumpOver) {
  place(0.06);
  kinematics_.velocity[0] = Vec3(30.0, 0.0, 0.0);
  const auto contacts = find();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(length(contacts[0].normal + Vec3::UnitX()), 0.0, 1e-3);
  EXPECT_NEAR(contacts[0].gap, 0.035, 1e-4);
}

// Beyond the axis the normal is kept and the limit fades until the twig has left. Substeps have one
// centimetre of relative motion; distant branches do not count, and the number is limited.
TEST_F(ContactFinderTest, StepsBesideFastWoodAreTakenInParts) {
  const auto parts = [&](double x, double body, double twig) {
    place(x);
    body_.velocity = Vec3(body, 0.0, 0.0);
    kinematics_.velocity[0] = Vec3(twig, 0.0, 0.0);
    return finder_.countSubsteps(contactTree(), {{body_.id, body_}}, 0, STEP);
  };
  EXPECT_EQ(parts(-0.03, 1.0, 0.0), 1);
  EXPECT_EQ(parts(-0.03, 2.3, 0.0), 1);
  EXPECT_EQ(parts(-0.03, 2.5, 0.0), 2);
  EXPECT_EQ(parts(-0.03, 0.0, -2.5), 2);
  EXPECT_EQ(parts(-0.03, 2.5, 2.5), 1);
  EXPECT_EQ(parts(-0.03, 6.0, 0.0), 3);
  EXPECT_EQ(parts(-0.03, 100.0, 0.0), 4);
  EXPECT_EQ(parts(-0.5, 6.0, 0.0), 1);
}

// S1-W6. Contacts of thin wood are harder; from 1 to 1.2 cm of radius on the law holds.
TEST_F(ContactFinderTest, ThinWoodIsHarder) {
  const auto bears = [&](double radius) {
    skeleton_.branches[0].base_radius = skeleton_.branches[0].tip_radius = radius;
    place(-0.02);
    return find().at(0).hardness;
  };
  EXPECT_EQ(bears(0.003), 5.0);
  EXPECT_EQ(bears(0.01), 5.0);
  EXPECT_NEAR(bears(0.011), 3.0, 1e-6);
  EXPECT_NEAR(bears(0.012), 1.0, 1e-9);
  EXPECT_EQ(bears(0.05), 1.0);
}

TEST_F(ContactFinderTest, TwigKeepsItsSideUntilItIsOverrun) {
  double last_share = 1.0;
  for (double x = -0.028; x < 0.025; x += 0.002) {
    place(x);
    const auto contacts = find();
    ASSERT_EQ(contacts.size(), 1u) << x;
    EXPECT_GT(contacts[0].normal.x(), 0.99) << x;
    EXPECT_NEAR(contacts[0].gap, -x - 0.025, 1e-5) << x;
    EXPECT_LE(contacts[0].share, last_share);
    last_share = contacts[0].share;
  }
  EXPECT_LT(last_share, 0.05);
  place(0.035);
  EXPECT_TRUE(find().empty());
  EXPECT_TRUE(persistent_.empty());
}

TEST_F(ContactFinderTest, ReactionIsOppositeAndInTheWorld) {
  place(-0.02);
  auto contacts = find();
  ASSERT_EQ(contacts.size(), 1u);
  contacts[0].force = 12.0;
  std::vector<Reaction> reactions;
  finder_.recordForces(contactTree(), {{body_.id, body_}}, contacts, STEP, persistent_, reactions);
  ASSERT_EQ(reactions.size(), 1u);
  const Reaction& reaction = reactions[0];
  EXPECT_EQ(reaction.kind, Reaction::CONTACT);
  EXPECT_EQ(reaction.body, "arm");
  EXPECT_EQ(reaction.frame, "hand");
  EXPECT_EQ(reaction.at.tree, 3u);
  EXPECT_NEAR(reaction.force.x(), -12.0, 1e-4);
  EXPECT_NEAR(length(reaction.point - (FOOT + Vec3(0.0, 0.0, 0.5))), 0.0, 1e-3);
  EXPECT_NEAR(reaction.penetration, 0.005, 1e-6);
  EXPECT_EQ(persistent_[0].force, 12.0);
}

}  // namespace
}  // namespace vegetation_sim::forest
