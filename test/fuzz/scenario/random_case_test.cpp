// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Random worlds neither diverge nor differ when they are replayed. Environment variables choose a
// longer run: VEGETATION_SIM_FUZZ_CASES (200), VEGETATION_SIM_FUZZ_SEED (1) and
// VEGETATION_SIM_FUZZ_FIRST (0), the number of the first case.
#include "fuzz/scenario/random_case.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "sanitized.h"

namespace vegetation_sim::fuzz {
namespace {

std::uint64_t numberFrom(const char* variable, std::uint64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(RandomCase, NeitherDivergesNorDiffersInAReplay) {
  const std::uint64_t seed = numberFrom("VEGETATION_SIM_FUZZ_SEED", 1);
  const std::uint64_t first = numberFrom("VEGETATION_SIM_FUZZ_FIRST", 0);
  const std::uint64_t count = numberFrom("VEGETATION_SIM_FUZZ_CASES", SANITIZED ? 20 : 200);
  std::set<std::uint64_t> hashes;
  long requests = 0, rejected = 0, ticks = 0;
  for (std::uint64_t number = first; number < first + count; ++number) {
    SCOPED_TRACE("case " + std::to_string(number) + " of seed " + std::to_string(seed));
    try {
      const CaseOutcome once = runCase(seed, number, 1);
      EXPECT_EQ(runCase(seed, number, number % 8 == 0 ? 3 : 1).hash, once.hash);
      hashes.insert(once.hash);
      ticks += once.ticks;
      requests += once.requests;
      rejected += once.rejected;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  RecordProperty("ticks", std::to_string(ticks));
  RecordProperty("requests", std::to_string(requests));
  RecordProperty("rejected", std::to_string(rejected));
  std::printf("%llu cases, %ld ticks, %ld requests, %ld of them rejected\n",
              static_cast<unsigned long long>(count), ticks, requests, rejected);
  EXPECT_EQ(hashes.size(), count) << "each case is another world";
  EXPECT_LT(rejected, requests / 2) << "most requests have an effect";
}

}  // namespace
}  // namespace vegetation_sim::fuzz
