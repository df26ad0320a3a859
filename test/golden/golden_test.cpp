// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Every shared scene gives the hashes and the number of the golden file, on every instruction set.
// usage: golden_test [GoogleTest options] | --record FILE
// VEGETATION_SIM_GOLDEN_THREADS="1 2 4" runs each of them with each number of threads; without it,
// 1 and 4 threads take turns.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <ostream>
#include <sstream>

#include "golden/golden_file.h"
#include "package_folder.h"
#include "vegetation_sim/core/config/instruction_set.h"

namespace vegetation_sim::golden {
namespace {

const char* const GOLDEN_FILE = PACKAGE_FOLDER "/test/golden/golden.yaml";

struct Case {
  scenes::SceneEntry scene;
  std::string instruction_set;
  int threads;
};

void PrintTo(const Case& scene, std::ostream* out) {
  *out << scene.scene.covers;
}

/// Returns the numbers of threads of the environment; none without it.
std::vector<int> requestedThreads() {
  const char* text = std::getenv("VEGETATION_SIM_GOLDEN_THREADS");
  std::istringstream in(text ? text : "");
  std::vector<int> out;
  for (int threads = 0; in >> threads;) out.push_back(threads);
  return out;
}

std::vector<Case> allCases() {
  const std::vector<int> requested = requestedThreads();
  std::vector<Case> out;
  for (const scenes::SceneEntry& scene : scenes::allScenes())
    for (const std::string& set : instructionSets()) {
      if (requested.empty()) out.push_back({scene, set, out.size() % 2 == 0 ? 1 : 4});
      for (const int threads : requested) out.push_back({scene, set, threads});
    }
  return out;
}

std::string nameOf(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.scene.name) + "_" + info.param.instruction_set + "_" +
         std::to_string(info.param.threads) + (info.param.threads == 1 ? "_thread" : "_threads");
}

class Golden : public testing::TestWithParam<Case> {
 protected:
  void TearDown() override { forceInstructionSet(""); }
};

TEST_P(Golden, SceneGivesTheRecordedHashesAndNumber) {
  const Case& scene = GetParam();
  const std::map<std::string, Record> golden = readGolden(GOLDEN_FILE);
  ASSERT_EQ(golden.count(scene.scene.name), 1u) << "no record of this scene";
  const Record& expected = golden.at(scene.scene.name);
  forceInstructionSet(scene.instruction_set);
  const Record actual = recordOf(scenes::run(scene.scene, scene.threads));
  EXPECT_EQ(actual.number, expected.number) << scene.scene.measured;
  EXPECT_EQ(actual.state, expected.state);
  EXPECT_EQ(actual.reference, expected.reference);
  EXPECT_EQ(actual.display, expected.display);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(allCases()), nameOf);

TEST(GoldenFile, HasNoSceneThatIsNotRun) {
  EXPECT_EQ(readGolden(GOLDEN_FILE).size(), scenes::allScenes().size());
}

}  // namespace
}  // namespace vegetation_sim::golden

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc != 3 || std::string(argv[1]) != "--record") return RUN_ALL_TESTS();
  try {
    vegetation_sim::golden::recordGolden(argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "golden_test: %s\n", error.what());
    return 1;
  }
  return 0;
}
