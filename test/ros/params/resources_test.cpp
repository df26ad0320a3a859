// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/resources.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "core/error_text.h"
#include "package_folder.h"

namespace vegetation_sim {
namespace {

const std::string FOLDER = PACKAGE_FOLDER;

class Resources : public testing::Test {
 protected:
  void SetUp() override { setenv("ROS_PACKAGE_PATH", PACKAGE_FOLDER, 1); }
};

TEST_F(Resources, RelativeNamesCountFromTheFolder) {
  EXPECT_EQ(resolveFile("../terrain/hills.yaml", "/scenes/forest"), "/scenes/terrain/hills.yaml");
  EXPECT_EQ(resolveFile("/terrain/hills.yaml", "/scenes"), "/terrain/hills.yaml");
  EXPECT_EQ(resolveFile("file:///terrain/hills.yaml", "/scenes"), "/terrain/hills.yaml");
  EXPECT_EQ(resolveFile("hills.yaml"), std::filesystem::absolute("hills.yaml").string());
  EXPECT_EQ(resolveFile("", "/scenes"), "");
}

TEST_F(Resources, PackagesAreFound) {
  EXPECT_EQ(resolveFile("package://vegetation_sim/config/terrain/hills.yaml", "/scenes"),
            FOLDER + "/config/terrain/hills.yaml");
}

TEST_F(Resources, ErrorNamesTheUnknownPackage) {
  EXPECT_EQ(errorOf([] { resolveFile("package://no_such_package/hills.yaml"); }),
            "package://no_such_package/hills.yaml: package 'no_such_package' is not known here");
}

TEST_F(Resources, TerrainIsTheSameByPathAndByPackage) {
  const auto by_path = loadTerrain(FOLDER + "/config/terrain/hills.yaml");
  const auto by_package = loadTerrain("package://vegetation_sim/config/terrain/hills.yaml");
  EXPECT_FALSE(by_path->isFlat());
  EXPECT_EQ(by_path->hash(), by_package->hash());
  EXPECT_TRUE(loadTerrain("")->isFlat());
}

TEST_F(Resources, AddressesOnTheNetworkAreRejected) {
  EXPECT_NE(errorOf([] { resolveFile("http://127.0.0.1/hills.yaml"); }), "");
}

TEST_F(Resources, MessagesNameFilesOfPackagesAndListedFoldersOnly) {
  const std::string inside = FOLDER + "/config/terrain/hills.yaml";
  EXPECT_EQ(findPublishedFile("package://vegetation_sim/config/terrain/hills.yaml", {}), inside);
  EXPECT_EQ(findPublishedFile(inside, {}), inside);
  EXPECT_EQ(findPublishedFile("/maps/of/hills.yaml", {"/maps/"}), "/maps/of/hills.yaml");
  for (const char* address :
       {"/etc/hostname", "hills.yaml", "file:///etc/hostname", "http://127.0.0.1/hills.yaml",
        "package://vegetation_sim/../../../../../../etc/hostname", "package://../etc/hostname",
        "/maps/../etc/hostname", "/mapsofothers/hills.yaml"})
    EXPECT_NE(errorOf([&] {
                findPublishedFile(address, {"/maps", "relative", ""});
              }),
              "")
        << address;
  EXPECT_EQ(errorOf([] { findPublishedFile("/etc/hostname", {}); }),
            "file '/etc/hostname' is in no package and in no folder of the parameter "
            "resource_folders");
}

// Else whoever publishes could read the files of this machine on /rosout and /diagnostics.
TEST_F(Resources, ErrorsAboutPublishedTerrainShowNothingOfTheFile) {
  const std::string address = "package://vegetation_sim/LICENSE";
  EXPECT_EQ(errorOf([&] { loadPublishedTerrain(address, {}); }),
            "terrain = '" + address + "' is no height map here");
  EXPECT_NE(errorOf([] { loadPublishedTerrain("/etc/hostname", {}); }), "");
  EXPECT_TRUE(loadPublishedTerrain("", {})->isFlat());
}

TEST_F(Resources, ErrorNamesTheMissingTerrain) {
  EXPECT_NE(errorOf([] { loadTerrain("/nowhere/hills.yaml"); }).find("/nowhere/hills.yaml"),
            std::string::npos);
}

}  // namespace
}  // namespace vegetation_sim
