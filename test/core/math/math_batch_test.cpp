// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/math_batch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "vegetation_sim/core/config/instruction_set.h"
#include "vegetation_sim/core/math/math.h"
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

bool sameBits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

std::vector<double> angles(bool huge) {
  std::vector<double> out{0.0, -0.0, 1e-300, -1e-9, 999999.0, -999999.0};
  for (int k = -16; k <= 16; ++k)
    for (const double off : {-1e-15, 0.0, 1e-15}) out.push_back((k + off) * PI / 4.0);
  const Random random(5);
  for (std::uint64_t i = 0; i < 2000; ++i) out.push_back(random.uniform(i, -20.0, 20.0));
  if (huge) out[500] = 1e7;
  return out;
}

TEST(MathBatch, SineAndCosineHaveTheBitsOfSinCosOnEveryInstructionSet) {
  for (const std::string& set : instructionSets())
    for (const bool huge : {false, true}) {
      const std::vector<double> angle = angles(huge);
      std::vector<double> sin(angle.size()), cos(angle.size());
      forceInstructionSet(set);
      batchSinCos(angle.data(), angle.size(), sin.data(), cos.data());
      forceInstructionSet("");
      for (std::size_t i = 0; i < angle.size(); ++i) {
        const SinCos plain = sinCos(angle[i]);
        ASSERT_TRUE(sameBits(sin[i], plain.sin)) << set << ", sine of " << angle[i];
        ASSERT_TRUE(sameBits(cos[i], plain.cos)) << set << ", cosine of " << angle[i];
      }
    }
}

TEST(MathBatch, CosineOfTurnsHasTheBitsOfThePlainOneOnEveryInstructionSet) {
  std::vector<double> turns{0.0, -0.0, 1e-300, 1e9, -1e9, 1e15};
  for (int k = -16; k <= 16; ++k)
    for (const double off : {-1e-15, 0.0, 1e-15}) turns.push_back(k / 8.0 + off);
  const Random random(7);
  for (std::uint64_t i = 0; i < 2001; ++i) turns.push_back(random.uniform(i, -20.0, 20.0));
  for (const std::string& set : instructionSets()) {
    std::vector<double> cos = turns;
    forceInstructionSet(set);
    batchCosTurns(cos.data(), cos.size(), cos.data());
    forceInstructionSet("");
    for (std::size_t i = 0; i < turns.size(); ++i)
      ASSERT_TRUE(sameBits(cos[i], sinCosTurns(turns[i]).cos)) << set << ", " << turns[i];
  }
}

TEST(MathBatch, ArcTangentHasTheBitsOfThePlainOneOnEveryInstructionSet) {
  std::vector<double> y, x;
  for (const double a : {0.0, -0.0, 1.0, -1.0, 1e-300, -1e300})
    for (const double b : {0.0, -0.0, 1.0, -1.0, 2e-300, 1e300}) y.push_back(a), x.push_back(b);
  const Random random(6);
  for (std::uint64_t i = 0; i < 2001; ++i) {
    y.push_back(random.uniform(2 * i, -1.0, 1.0));
    x.push_back(random.uniform(2 * i + 1, -1.0, 1.0));
  }
  for (const std::string& set : instructionSets()) {
    std::vector<double> out(y.size());
    forceInstructionSet(set);
    batchArcTangent(y.data(), x.data(), y.size(), out.data());
    forceInstructionSet("");
    for (std::size_t i = 0; i < y.size(); ++i)
      ASSERT_TRUE(sameBits(out[i], arcTangent(y[i], x[i]))) << set << ", " << y[i] << ", " << x[i];
  }
}

}  // namespace
}  // namespace vegetation_sim
