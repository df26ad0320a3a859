// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// All displays run in one rviz beside the nodes that they subscribe to.
#include <OgreMaterialManager.h>
#include <OgreTechnique.h>

#include <algorithm>
#include <set>

#include "rviz/canopy/canopy_display.h"
#include "rviz/crowd/crowd_display.h"
#include "rviz/forest/forest_display.h"
#include "rviz/grass/grass_display.h"
#include "rviz/rigs/display_checks.h"
#include "rviz/wind/wind_display.h"

namespace vegetation_sim {
namespace {

/// One display of each kind.
struct Landscape {
  ForestDisplay* forest{nullptr};
  GrassDisplay* grass{nullptr};
  CanopyDisplay* canopy{nullptr};
  CrowdDisplay* crowd{nullptr};
  WindDisplay* wind{nullptr};

  std::vector<rviz::Display*> all() const { return {wind, forest, crowd, grass, canopy}; }
  bool drawn() const {
    return forest->drawn().trees == 2 && forest->drawn().waiting == 0 && grass->drawn().tiles > 0 &&
           canopy->drawn().plants == 2 && crowd->drawn().people == 3 && wind->drawn().arrows > 0;
  }
};

// rviz can be started only once in a process.
std::unique_ptr<ViewRig> shared_rig;

class LandscapeTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_rig = std::make_unique<ViewRig>(); }
  static void TearDownTestSuite() { shared_rig.reset(); }

  void SetUp() override { rig.lookAt(2.f, 0.3, 18.0); }

  Landscape add() {
    Landscape out;
    out.wind = rig.add<WindDisplay>("vegetation_sim/WindDisplay");
    out.forest = rig.add<ForestDisplay>("vegetation_sim/ForestDisplay");
    out.crowd = rig.add<CrowdDisplay>("vegetation_sim/CrowdDisplay");
    out.grass = rig.add<GrassDisplay>("vegetation_sim/GrassDisplay");
    out.canopy = rig.add<CanopyDisplay>("vegetation_sim/CanopyDisplay");
    return out;
  }
  /// Advances time with each frame, so that nodes can follow, until a condition holds.
  bool goOnUntil(const std::function<bool()>& done) {
    return rig.until([&] {
      rig.setTime(rig.now() + 0.03);
      rig.frames(1);
      return done();
    });
  }

  ViewRig& rig{*shared_rig};
};

/// Returns the display that draws an object which a scene has only once, as the status of a display
/// names it; "" stands for the display itself.
std::string giverOf(rviz::Display& display, const std::string& thing) {
  const std::string published = statusOf(display, "Scenery"), sought = thing + " by ";
  const std::size_t at = published.find(sought);
  if (at == published.npos) return {};
  const std::size_t from = at + sought.size();
  return published.substr(from, published.find(',', from) - from);
}

/// Disables or enables the techniques with shaders, as in a renderer without shaders.
void forgetShaders(bool forget) {
  Ogre::ResourceManager::ResourceMapIterator all =
      Ogre::MaterialManager::getSingleton().getResourceIterator();
  while (all.hasMoreElements()) {
    auto& material = static_cast<Ogre::Material&>(*all.getNext());
    if (material.getNumTechniques() < 2) continue;
    Ogre::Technique& shaded = *material.getTechnique(0);
    if (!shaded.getPass(0)->hasVertexProgram()) continue;
    shaded.setSchemeName(forget ? "forgotten" : Ogre::MaterialManager::DEFAULT_SCHEME_NAME);
    material.compile();
  }
}

TEST_F(LandscapeTest, EveryKindDrawsAndSharedSceneryIsDrawnOnce) {
  Landscape scene = add();
  ASSERT_TRUE(goOnUntil([&] { return scene.drawn(); }));
  EXPECT_TRUE(goOnUntil([&] {
    return giverOf(*scene.forest, "ground") == "vegetation_sim/GrassDisplay";
  })) << statusOf(*scene.forest, "Scenery");
  for (const char* thing : {"ground", "sky", "haze"}) {
    std::multiset<std::string> givers;
    EXPECT_TRUE(goOnUntil([&] {
      givers.clear();
      for (rviz::Display* display : scene.all()) givers.insert(giverOf(*display, thing));
      givers.erase("");
      return givers.size() >= 3 && givers.count(*givers.begin()) == givers.size();
    })) << thing
        << ": " << testing::PrintToString(givers);
  }
  rig.frames(3);
  const ImageStatistics seen = rig.imageStatistics();
  EXPECT_GT(seen.green, 0.15);
  EXPECT_GT(seen.blue, 0.05);
  EXPECT_GT(seen.spread, 15.0);
  // When the display that draws the ground is removed, another one draws it, and the others
  // continue.
  rig.remove(scene.grass);
  EXPECT_TRUE(goOnUntil([&] { return giverOf(*scene.forest, "ground").empty(); }));
  const std::vector<std::uint8_t> before = rig.picture();
  EXPECT_TRUE(goOnUntil([&] { return difference(before, rig.picture()) > 0.5; }));
  EXPECT_GT(rig.imageStatistics().green, 0.15);
  for (rviz::Display* display : scene.all())
    if (display != scene.grass) rig.remove(display);
}

TEST_F(LandscapeTest, WithoutShadersTheSceneIsSimplerButVisible) {
  const Landscape scene = add();
  ASSERT_TRUE(goOnUntil([&] { return scene.drawn(); }));
  rig.frames(3);
  const ImageStatistics shaded = rig.imageStatistics();
  const std::vector<std::uint8_t> before = rig.picture();
  forgetShaders(true);
  rig.frames(3);
  const ImageStatistics plain = rig.imageStatistics();
  const std::vector<std::uint8_t> after = rig.picture();
  forgetShaders(false);
  EXPECT_GT(difference(before, after), 0.5);
  EXPECT_NEAR(plain.green, shaded.green, 0.1);
  EXPECT_NEAR(plain.blue, shaded.blue, 0.1);
  EXPECT_GT(plain.spread, 15.0);
  for (rviz::Display* display : scene.all()) rig.remove(display);
}

// The displays are removed in any order.
TEST_F(LandscapeTest, LeavesNothingBehind) {
  Ogre::SceneManager& ogre = *rig.manager().getSceneManager();
  const Holdings before = holdings(ogre);
  const int times = timesOf("VEGETATION_SIM_CYCLES");
  MemoryLog log("cycles", times, ogre);
  for (int i = 0; i < times; ++i) {
    const Landscape scene = add();
    if (i % 4 == 0)
      ASSERT_TRUE(goOnUntil([&] { return scene.drawn(); }));
    else
      rig.frames(1);
    std::vector<rviz::Display*> all = scene.all();
    for (int k = 0; k < i; ++k) std::next_permutation(all.begin(), all.end());
    for (rviz::Display* display : all) {
      rig.remove(display);
      if (i % 3 == 0) rig.frames(1);
    }
    log.note(i);
  }
  EXPECT_EQ(holdings(ogre), before);
  EXPECT_EQ(ogre.getFogMode(), Ogre::FOG_NONE);
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "landscape_test");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
