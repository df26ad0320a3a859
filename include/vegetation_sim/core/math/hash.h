// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// FNV-1a, 64 bits, over values in the order in which they are added.
class Hash {
 public:
  void add(std::uint64_t value);
  /// Adds the bit pattern, so -0 and 0 differ.
  void add(double value);
  void add(const std::string& value);
  void add(const Vec3& v) { add(v.x()), add(v.y()), add(v.z()); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_{0xcbf29ce484222325ULL};
};

}  // namespace vegetation_sim
