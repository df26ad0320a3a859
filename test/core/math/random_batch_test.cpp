// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/random_batch.h"

#include <gtest/gtest.h>

#include <vector>

#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

using Words = std::vector<std::uint64_t>;

// Lists of all lengths up to several vectors; the first keys and indices are extreme.
TEST(RandomBatch, HasTheBitsOfRandomOnEveryInstructionSet) {
  for (const std::string& set : instructionSets())
    for (std::size_t count = 0; count < 70; ++count) {
      Words keys{0, ~0ULL, 1ULL << 32, 0xffffffffULL}, indices{~0ULL, 0, 0xffffffffULL, 1ULL << 32};
      for (std::uint64_t i = keys.size(); i < count; ++i) {
        keys.push_back(Random(3).bits(i));
        indices.push_back(i % 2 ? i : Random(4).bits(i));
      }
      Words bits(count + 1, 7), children(count + 1, 7);
      const std::uint64_t index = count % 3 ? count : indices[count % 4];
      forceInstructionSet(set);
      drawBits(keys.data(), count, index, bits.data());
      drawChildren(keys.data(), indices.data(), count, children.data());
      forceInstructionSet("");
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(bits[i], Random(keys[i]).bits(index)) << set << ", " << i << " of " << count;
        ASSERT_EQ(children[i], Random(keys[i]).child(indices[i]).key())
            << set << ", " << i << " of " << count;
      }
      ASSERT_EQ(bits[count], 7u) << set;
      ASSERT_EQ(children[count], 7u) << set;
    }
}

}  // namespace
}  // namespace vegetation_sim
