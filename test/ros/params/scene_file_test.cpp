// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/scene_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/error_text.h"
#include "package_folder.h"

namespace vegetation_sim {
namespace {

const std::string HILLS = std::string(PACKAGE_FOLDER) + "/config/terrain/hills.yaml";

class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    setenv("ROS_PACKAGE_PATH", PACKAGE_FOLDER, 1);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& text) const {
    std::ofstream(folder_ / "scene.yaml") << text;
    return (folder_ / "scene.yaml").string();
  }
  const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "scene_files";
};

TEST_F(SceneFiles, CommonPartIsReadAndSectionsOfOthersAreIgnored) {
  SceneBase scene;
  SceneFile file(write("{frame_id: world, seed: 7, terrain: " + HILLS + ", wind: {speed: 3}}"),
                 scene);
  file.loadTerrain();
  file.finish();
  EXPECT_EQ(scene.frame_id, "world");
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_FALSE(scene.terrain->isFlat());
  EXPECT_EQ(file.terrainName(), HILLS);
  EXPECT_EQ(file.folder(), folder_.string());
}

TEST_F(SceneFiles, PackageOfTheTerrainIsKeptInItsName) {
  SceneBase scene;
  const std::string name = "package://vegetation_sim/config/terrain/hills.yaml";
  EXPECT_EQ(SceneFile(write("{terrain: '" + name + "'}"), scene).terrainName(), name);
}

TEST_F(SceneFiles, AllFaultsAreReportedAtOnce) {
  SceneBase scene;
  SceneFile file(write("{seed: many, terrain: nowhere.yaml, trees: []}"), scene);
  file.loadTerrain();
  const std::string error = errorOf([&] { file.finish(); });
  for (const char* fault : {"seed", "terrain: ", "nowhere.yaml", "trees"})
    EXPECT_NE(error.find(fault), std::string::npos) << error;
  EXPECT_TRUE(scene.terrain->isFlat());
}

}  // namespace
}  // namespace vegetation_sim
