// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/model/ray_random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vegetation_sim::scan {
namespace {

TEST(RayRandom, NoiseHasMeanZeroAndDeviationOne) {
  double sum = 0.0, square = 0.0;
  constexpr int N = 20000;
  for (std::uint64_t i = 0; i < N; ++i) {
    const double x = RayRandom({4, i % 7}, i).unitNoise(0);
    EXPECT_LE(std::fabs(x), 6.0);
    sum += x;
    square += x * x;
  }
  EXPECT_NEAR(sum / N, 0.0, 4.0 / std::sqrt(N));
  EXPECT_NEAR(square / N, 1.0, 4.0 * std::sqrt(2.0 / N));
}

// The sum of twelve uniform numbers differs from the normal distribution by less than 0.003. The
// statistic of Kolmogorov and Smirnov exceeds 1.95 / sqrt(n) in one of a thousand samples.
TEST(RayRandom, NoiseIsNormallyDistributed) {
  constexpr int N = 40000;
  std::vector<double> all;
  for (std::uint64_t i = 0; i < N; ++i) all.push_back(RayRandom({9, 2}, i).unitNoise(i % 3));
  std::sort(all.begin(), all.end());
  double largest = 0.0;
  for (int i = 0; i < N; ++i) {
    const double normal = 0.5 * std::erfc(-all[static_cast<std::size_t>(i)] / std::sqrt(2.0));
    largest = std::max(
        {largest, std::fabs(normal - double(i) / N), std::fabs(normal - double(i + 1) / N)});
  }
  EXPECT_LT(largest, 0.003 + 1.95 / std::sqrt(N));
}

TEST(RayRandom, NumbersDifferByKeyRayAndEcho) {
  const double one = RayRandom({4, 1}, 2).unitNoise(0);
  EXPECT_EQ(RayRandom({4, 1}, 2).unitNoise(0), one);
  EXPECT_NE(RayRandom({4, 2}, 2).unitNoise(0), one);
  EXPECT_NE(RayRandom({5, 1}, 2).unitNoise(0), one);
  EXPECT_NE(RayRandom({4, 1, 1}, 2).unitNoise(0), one);
  EXPECT_NE(RayRandom({4, 1}, 3).unitNoise(0), one);
  EXPECT_NE(RayRandom({4, 1}, 2).unitNoise(1), one);
  const RayRandom ray({4, 1}, 2);
  EXPECT_NE(ray.detection(0), ray.detection(1));
  EXPECT_NE(ray.detection(0), ray.drop());
}

}  // namespace
}  // namespace vegetation_sim::scan
