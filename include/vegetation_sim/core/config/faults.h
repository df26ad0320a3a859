// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace vegetation_sim {

/// An input that is rejected. what() lists every fault, one per line.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collects all faults of one input, so that a user can mend them at once.
class Faults {
 public:
  /// Keeps the first hundred faults.
  void add(std::string fault) {
    if (list_.size() < 100) list_.push_back(std::move(fault));
  }
  bool empty() const { return list_.empty(); }
  const std::vector<std::string>& list() const { return list_; }
  /// Returns the faults, one per line.
  std::string text() const;
  /// @throws InvalidInput with text() if there is a fault.
  void throwIfAny() const;

 private:
  std::vector<std::string> list_;
};

}  // namespace vegetation_sim
