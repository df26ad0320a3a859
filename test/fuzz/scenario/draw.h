// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::fuzz {

/// Random numbers in a row, which depend on the key only.
class Draw {
 public:
  explicit Draw(const Random& random) : random_(random) {}
  double between(double low, double high) { return random_.uniform(next_++, low, high); }
  /// Returns 0 to count - 1.
  int below(int count) { return static_cast<int>(between(0.0, count)); }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  /// Returns a number whose logarithm is uniform.
  double logarithmic(double low, double high);
  /// Each component is within `size`.
  Vec3 point(double size) {
    const double x = between(-size, size), y = between(-size, size);
    return Vec3(x, y, between(-size, size));
  }
  std::uint64_t key() { return random_.bits(next_++); }

 private:
  Random random_;
  std::uint64_t next_{0};
};

/// Changes some fields of a described structure: numbers to 1 / `factor` to `factor` times their
/// value within their range, choices to any but the formulas as papers print them, some of which
/// are there to show that they fail.
class RandomFields : public FieldVisitor {
 public:
  RandomFields(Draw& draw, double factor, double share = 0.3)
      : draw_(draw), factor_(factor), share_(share) {}
  void number(const char* name, double& value, const char* unit, Range range) override;
  void integer(const char* name, int& value, const char* unit, Range range) override;
  void vector(const char* name, Vec3& value, const char* unit, Range range) override;
  void choice(const char* name, int& value, const std::vector<std::string>& names) override;

 private:
  Draw& draw_;
  double factor_, share_;
};

/// Returns up to three primitives of any kind with stamps around `start`.
wind::Field randomWind(Draw& draw, Nanoseconds start);

}  // namespace vegetation_sim::fuzz
