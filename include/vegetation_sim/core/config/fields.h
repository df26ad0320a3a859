// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "vegetation_sim/core/config/faults.h"
#include "vegetation_sim/core/math/hash.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim {

/// Closed range of allowed values.
struct Range {
  double low, high;
  bool contains(double value) const { return value >= low && value <= high; }
};

/// A parameter structure declares each field once, in a free function `describe(FieldVisitor&,
/// T&)`, with name, unit and range. Reading, checking, writing, hashing and documentation all visit
/// that declaration, so they cannot disagree.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;
  virtual void number(const char* name, double& value, const char* unit, Range range) = 0;
  virtual void integer(const char* name, int& value, const char* unit, Range range) = 0;
  /// Visits three numbers, each within `range`.
  virtual void vector(const char* name, Vec3& value, const char* unit, Range range) = 0;
  /// Visits an index into `names`.
  virtual void choice(const char* name, int& value, const std::vector<std::string>& names) = 0;

  /// Visits an enum, whose values are 0, 1, ... in the order of `names`, as its index. A derived
  /// class hides this overload unless it says `using FieldVisitor::choice;`.
  template <class Enum, class = std::enable_if_t<std::is_enum_v<Enum>>>
  void choice(const char* name, Enum& value, const std::vector<std::string>& names) {
    int index = static_cast<int>(value);
    choice(name, index, names);
    value = static_cast<Enum>(index);
  }
};

/// Returns "name = value unit is outside low to high", or an empty text if the value is finite and
/// in range.
std::string rangeFault(const std::string& name, double value, const char* unit, Range range);

/// Adds a fault for each field that is not finite or out of range; `context` names the owner.
class FieldChecker : public FieldVisitor {
 public:
  FieldChecker(std::string context, Faults& faults)
      : context_(std::move(context)), faults_(faults) {}
  void number(const char* name, double& value, const char* unit, Range range) override;
  void integer(const char* name, int& value, const char* unit, Range range) override;
  void vector(const char* name, Vec3& value, const char* unit, Range range) override;
  void choice(const char* name, int& value, const std::vector<std::string>& names) override;

 private:
  std::string context_;
  Faults& faults_;
};

/// Adds every field's bits to a hash.
class FieldHasher : public FieldVisitor {
 public:
  explicit FieldHasher(Hash& hash) : hash_(hash) {}
  void number(const char*, double& value, const char*, Range) override { hash_.add(value); }
  void integer(const char*, int& value, const char*, Range) override;
  void vector(const char*, Vec3& value, const char*, Range) override { hash_.add(value); }
  void choice(const char*, int& value, const std::vector<std::string>&) override;

 private:
  Hash& hash_;
};

}  // namespace vegetation_sim
