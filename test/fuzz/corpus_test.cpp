// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Every seed and every kept input of a fuzz target, and mutations of them, are read within the
// limits of time and memory. Environment variables choose a longer run:
// VEGETATION_SIM_FUZZ_MUTATIONS (50), their number for each target, and VEGETATION_SIM_FUZZ_KEEP,
// a folder into which inputs beyond the limits are written, and the one that is running.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fuzz/cost.h"
#include "fuzz/fuzz_target.h"
#include "fuzz/mutation.h"
#include "heap.h"
#include "package_folder.h"
#include "sanitized.h"

namespace vegetation_sim::fuzz {
namespace {

struct Input {
  std::string name, bytes;
};

std::vector<Input> inputsOf(const Target& target) {
  std::vector<Input> out;
  for (const std::string& seed : target.seeds())
    out.push_back({"seed " + std::to_string(out.size()), seed});
  const std::filesystem::path folder =
      std::filesystem::path(PACKAGE_FOLDER) / "test/fuzz/corpus" / target.name;
  if (!std::filesystem::exists(folder)) return out;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    std::ostringstream bytes;
    bytes << std::ifstream(file.path(), std::ios::binary).rdbuf();
    out.push_back({file.path().filename().string(), bytes.str()});
  }
  return out;
}

/// Processor time of the fastest of three runs, which other processes disturb least [s].
double secondsOf(const Target& target, const std::string& bytes) {
  double best = 1e9;
  for (int i = 0; i < 3 && best > MOST_SECONDS; ++i) {
    const double start = processorSeconds();
    target.run(bytes);
    best = std::min(best, processorSeconds() - start);
  }
  return best;
}

/// Runs an input. @return whether it kept the limits.
bool keepsLimits(const Target& target, const Input& input) {
  restartPeak();
  const long before = liveBytes();
  double seconds = 0.0;
  try {
    seconds = secondsOf(target, input.bytes);
  } catch (const std::exception& error) {
    ADD_FAILURE() << input.name << ": " << error.what();
    return false;
  }
  const long bytes = peakBytes() - before;
  EXPECT_LE(bytes, mostBytes(input.bytes.size())) << input.name;
  if (SANITIZED) return bytes <= mostBytes(input.bytes.size());
  EXPECT_LE(seconds, MOST_SECONDS) << input.name;
  return seconds <= MOST_SECONDS && bytes <= mostBytes(input.bytes.size());
}

/// Writes an input into the folder of VEGETATION_SIM_FUZZ_KEEP, if there is one.
void keep(const std::string& name, const std::string& bytes) {
  if (const char* folder = std::getenv("VEGETATION_SIM_FUZZ_KEEP"))
    std::ofstream(std::string(folder) + "/" + name, std::ios::binary) << bytes;
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, IsReadWithinTheLimits) {
  const Target& target = GetParam();
  target.run({});  // what is computed once in a process
  for (const Input& input : inputsOf(target)) keepsLimits(target, input);
}

TEST_P(Corpus, MutationsAreReadWithinTheLimits) {
  const Target& target = GetParam();
  const char* text = std::getenv("VEGETATION_SIM_FUZZ_MUTATIONS");
  const std::uint64_t count = text ? std::strtoull(text, nullptr, 10) : 50;
  std::vector<std::string> inputs;
  for (const Input& input : inputsOf(target)) inputs.push_back(input.bytes);
  target.run({});
  for (std::uint64_t number = 0; number < count; ++number) {
    const Input input{"mutation " + std::to_string(number),
                      mutate(inputs, Random(1).child(number))};
    keep(std::string(target.name) + "_running", input.bytes);
    if (!keepsLimits(target, input))
      keep(std::string(target.name) + "_" + std::to_string(number), input.bytes);
  }
}

std::string nameOf(const testing::TestParamInfo<Target>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, testing::ValuesIn(allTargets()), nameOf);

TEST(FuzzTarget, UnknownNameIsRejectedWithTheKnownOnes) {
  EXPECT_EQ(findTarget("wind").name, std::string("wind"));
  EXPECT_THROW(findTarget("no_such_target"), std::invalid_argument);
}

TEST(FuzzTarget, PiecesAreReadAsWritten) {
  const std::string input = pieceOf(3, "abc") + pieceOf(0, "") + pieceOf(7, "rest");
  const std::vector<Piece> pieces = splitPieces(input);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[0].kind, 3);
  EXPECT_EQ(pieces[0].bytes, "abc");
  EXPECT_EQ(pieces[1].bytes, "");
  EXPECT_EQ(pieces[2].bytes, "rest");
  EXPECT_EQ(splitPieces(input.substr(0, input.size() - 2))[2].bytes, "re");
}
}  // namespace
}  // namespace vegetation_sim::fuzz
