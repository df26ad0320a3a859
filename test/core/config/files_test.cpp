// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/config/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error_text.h"

namespace vegetation_sim {
namespace {

/// A folder of this test, which is deleted afterwards.
class Files : public testing::Test {
 protected:
  Files()
      : folder_(std::filesystem::temp_directory_path() / ("files_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Files() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

TEST_F(Files, AreReadUpToTheLimit) {
  std::ofstream(path("text"), std::ios::binary) << std::string("a\0b", 3);
  EXPECT_EQ(readFile(path("text"), 3), std::string("a\0b", 3));
  EXPECT_EQ(errorOf([&] { readFile(path("text"), 2); }),
            path("text") + ": 3 bytes, more than the 2 allowed");
}

// They may never end, or never begin.
TEST_F(Files, DevicesPipesAndFoldersAreNotOpened) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  for (const std::string& name : {path("pipe"), std::string("/dev/zero"), folder_.string()})
    EXPECT_EQ(errorOf([&] { readFile(name, 1000); }),
              name + ": cannot be read: it is no regular file");
}

}  // namespace
}  // namespace vegetation_sim
