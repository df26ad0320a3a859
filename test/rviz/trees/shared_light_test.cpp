// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/trees/shared_light.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace vegetation_sim::view {
namespace {

// Only the address of a scene counts.
const Ogre::SceneManager* sceneOf(std::uintptr_t number) {
  return reinterpret_cast<const Ogre::SceneManager*>(number);
}

std::shared_ptr<const forest::LightGrid> crown() {
  auto out = std::make_shared<forest::LightGrid>(Vec3(-5, -5, 0), Vec3(5, 5, 8), 0.5);
  for (int i = 0; i < 4000; ++i)
    out->addLeaf(Vec3(-2.0 + 0.2 * (i % 20), -2.0 + 0.2 * (i / 20 % 20), 4.0 + 0.2 * (i / 400)),
                 0.02);
  out->cast(Vec3(0.0, 0.0, 1.0));
  return out;
}

TEST(SharedLight, IsLessUnderACrownForDisplaysOfTheSameSceneAndFrame) {
  const Vec3 under(0.0, 0.0, 1.0), beside(4.5, 4.5, 1.0);
  {
    const SharedLight light(sceneOf(64), "map", crown());
    const SharedLight::Shares shade = SharedLight::at(sceneOf(64), "map", under);
    EXPECT_LT(shade.sun, 0.3);
    EXPECT_LT(shade.sky, 0.8);
    EXPECT_GT(SharedLight::at(sceneOf(64), "map", beside).sun, 0.95);
    EXPECT_EQ(SharedLight::at(sceneOf(128), "map", under).sun, 1.0);
    EXPECT_EQ(SharedLight::at(sceneOf(64), "odom", under).sun, 1.0);
    const SharedLight again(sceneOf(64), "map", crown());
    EXPECT_NEAR(SharedLight::at(sceneOf(64), "map", under).sun, shade.sun * shade.sun, 1e-12);
  }
  EXPECT_EQ(SharedLight::at(sceneOf(64), "map", under).sun, 1.0);
}

}  // namespace
}  // namespace vegetation_sim::view
