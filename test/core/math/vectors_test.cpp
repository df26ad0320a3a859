// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/vectors.h"

#include <gtest/gtest.h>

#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

constexpr double ROUNDING = 1e-15;  // a few units in the last place of 1

Quat randomRotation(std::uint64_t i) {
  const Random random = Random(1).child(i);
  Quat q{random.uniform(0, -1, 1), random.uniform(1, -1, 1), random.uniform(2, -1, 1),
         random.uniform(3, -1, 1)};
  const double n = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / n, q.x / n, q.y / n, q.z / n};
}

Eigen::Quaterniond asEigen(const Quat& q) {
  return {q.w, q.x, q.y, q.z};
}

TEST(Quat, ProductsAndRotationsAreThoseOfEigen) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Quat a = randomRotation(2 * i), b = randomRotation(2 * i + 1);
    const Vec3 v(Random(2).uniform(i), -0.5, Random(3).uniform(i));
    EXPECT_LT((asEigen(a * b).coeffs() - (asEigen(a) * asEigen(b)).coeffs()).norm(), ROUNDING);
    EXPECT_LT((rotate(a, v) - asEigen(a) * v).norm(), 2.0 * ROUNDING);
    EXPECT_LT((rotate(conjugate(a), rotate(a, v)) - v).norm(), 4.0 * ROUNDING);
  }
}

TEST(Quat, AxesAreTheRotatedUnitVectors) {
  const Quat q = randomRotation(5);
  EXPECT_LT((axisX(q) - rotate(q, Vec3::UnitX())).norm(), ROUNDING);
  EXPECT_LT((axisY(q) - rotate(q, Vec3::UnitY())).norm(), ROUNDING);
  EXPECT_LT((axisZ(q) - rotate(q, Vec3::UnitZ())).norm(), ROUNDING);
}

}  // namespace
}  // namespace vegetation_sim
