// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace vegetation_sim {

/// Refused input. what() lists every fault, one a line.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All that is wrong with one input, so that a user mends it in one go.
class Faults {
 public:
  /// Keeps the first hundred.
  void add(std::string fault) {
    if (list_.size() < 100) list_.push_back(std::move(fault));
  }
  bool empty() const { return list_.empty(); }
  const std::vector<std::string>& list() const { return list_; }
  /// One fault a line.
  std::string text() const;
  /// @throws InvalidInput with text() if there is any.
  void throwIfAny() const;

 private:
  std::vector<std::string> list_;
};

}  // namespace vegetation_sim
