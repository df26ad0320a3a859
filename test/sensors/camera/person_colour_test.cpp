// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/person_colour.h"

#include <gtest/gtest.h>

#include "crowd/body/body_skeleton.h"

namespace vegetation_sim::scan {
namespace {

crowd::Clothes clothes() {
  crowd::Clothes out = crowd::clothesOf(7);
  out.cut = crowd::HairCut::SHORT;
  out.pattern = crowd::Pattern::PLAIN;
  out.long_sleeves = true;
  out.skin = Vec3(0.8, 0.6, 0.5);
  out.hair = Vec3(0.3, 0.2, 0.1);
  out.shirt = Vec3(0.2, 0.3, 0.5);
  out.second = Vec3(0.9, 0.9, 0.9);
  return out;
}

LimbPlace placeOn(crowd::Part part, double along, const Vec3& normal) {
  return {static_cast<std::size_t>(part), along, normal, Vec3::UnitX()};
}

TEST(PersonColour, ShowsTheFaceInFrontAndHairBehindAndAbove) {
  const crowd::Clothes own = clothes();
  const auto head = [&](double along, const Vec3& normal) {
    return personColour(own, placeOn(crowd::Part::HEAD, along, normal));
  };
  EXPECT_EQ(head(0.2, Vec3::UnitX()), own.skin);
  EXPECT_EQ(head(0.2, -Vec3::UnitX()), own.hair);
  EXPECT_EQ(head(1.5, Vec3::UnitZ()), own.hair);
  const Vec3 aside = Vec3(0.93, 0.36, 0.0).normalized();
  EXPECT_LT(head(0.65, aside).maxCoeff(), 0.2) << "an eye";
  EXPECT_EQ(head(0.65, Vec3::UnitX()), own.skin) << "between the eyes";
}

TEST(PersonColour, OfABaldHeadIsThatOfSkin) {
  crowd::Clothes own = clothes();
  own.cut = crowd::HairCut::BALD;
  EXPECT_EQ(personColour(own, placeOn(crowd::Part::HEAD, 1.5, Vec3::UnitZ())), own.skin);
}

TEST(PersonColour, LeavesHandsBareBelowLongSleeves) {
  const crowd::Clothes own = clothes();
  EXPECT_EQ(personColour(own, placeOn(crowd::Part::FOREARM, 0.4, Vec3::UnitX())), own.shirt);
  EXPECT_EQ(personColour(own, placeOn(crowd::Part::FOREARM, 0.9, Vec3::UnitX())), own.skin);
}

TEST(PersonColour, HasBothColoursOfStripes) {
  crowd::Clothes own = clothes();
  own.pattern = crowd::Pattern::STRIPES;
  int second = 0;
  for (int i = 0; i < 100; ++i)
    second += personColour(own, placeOn(crowd::Part::CHEST, 0.01 * i, Vec3::UnitX())) == own.second;
  EXPECT_NEAR(second, 50, 10);
}

TEST(PersonColour, FrontIsAcrossShouldersFromLeftToRight) {
  const Rod shoulders = rodBetween(Vec3(1.0, 0.3, 1.5), Vec3(1.0, -0.3, 1.5), 0.1, 0.1);
  EXPECT_NEAR(frontOf(shoulders).x(), 1.0, 1e-12);
}

}  // namespace
}  // namespace vegetation_sim::scan
