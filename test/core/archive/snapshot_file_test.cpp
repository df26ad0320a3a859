// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/archive/snapshot_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/config/files.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

SnapshotFile makeExample() {
  SnapshotFile out;
  out.header = {"forest_animator", 7, 123456789, 0xabcdef};
  out.payload = "payload of some length";
  return out;
}

std::string faultOfFile(const std::string& bytes, const std::string& node = "forest_animator") {
  try {
    decodeSnapshot("file", bytes, node);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(SnapshotFile, DecodesWhatItEncodes) {
  const SnapshotFile read =
      decodeSnapshot("file", encodeSnapshot(makeExample()), "forest_animator");
  EXPECT_EQ(read.header.node, "forest_animator");
  EXPECT_EQ(read.header.layout_hash, 7u);
  EXPECT_EQ(read.header.stamp, 123456789);
  EXPECT_EQ(read.header.state_hash, 0xabcdefu);
  EXPECT_EQ(read.payload, makeExample().payload);
}

TEST(SnapshotFile, RejectsEveryTruncatedFile) {
  const std::string bytes = encodeSnapshot(makeExample());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(faultOfFile(bytes.substr(0, size)).compare(0, 6, "file: "), 0) << size << " bytes";
}

TEST(SnapshotFile, RejectsEveryFlippedBit) {
  const std::string bytes = encodeSnapshot(makeExample());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string altered = bytes;
    altered[bit / 8] = static_cast<char>(altered[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(faultOfFile(altered), "") << "bit " << bit;
  }
}

TEST(SnapshotFile, RejectsAnotherVersionByItsNumber) {
  std::string bytes = encodeSnapshot(makeExample());
  bytes[std::string("vegetation_sim snapshot\n").size()] = 99;
  EXPECT_EQ(faultOfFile(bytes),
            "file: version = 99 of the format, allowed is " + std::to_string(SNAPSHOT_VERSION));
}

TEST(SnapshotFile, RejectsTheSnapshotOfAnotherNode) {
  EXPECT_EQ(faultOfFile(encodeSnapshot(makeExample()), "grass_field"),
            "file: node = 'forest_animator', allowed is 'grass_field'");
  EXPECT_EQ(faultOfFile("something else"), "file: it is no snapshot of vegetation_sim");
}

TEST(SnapshotFile, IsReplacedAsAWholeOrNotAtAll) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / "vegetation_sim_snapshot_file_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "state").string();
  replaceFile(file, "first", true);
  replaceFile(file, "second", false);
  EXPECT_EQ(readFile(file, 100), "second");
  EXPECT_THROW(replaceFile((folder / "none" / "state").string(), "x", true), InvalidInput);
  std::filesystem::create_directory(file + ".part");  // nothing can be written there
  EXPECT_THROW(replaceFile(file, "third", true), InvalidInput);
  EXPECT_EQ(readFile(file, 100), "second");
  std::filesystem::remove_all(folder);
}

TEST(SnapshotFile, AcceptsPlainNamesOnly) {
  EXPECT_NO_THROW(checkPlainName("file", "demo-1.forest_animator"));
  for (const char* name : {"", "..", ".hidden", "a/b", "../a", "a b", "a\nb", "\xc3\xa4"})
    EXPECT_THROW(checkPlainName("file", name), InvalidInput) << name;
  EXPECT_THROW(checkPlainName("file", std::string(65, 'a')), InvalidInput);
}

}  // namespace
}  // namespace vegetation_sim
