// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace vegetation_sim {

/// Why an input is rejected; as in msg/ErrorCode.msg.
enum class FaultCode : std::uint8_t {
  NONE = 0,
  INVALID_VALUE = 1,
  UNKNOWN = 2,
  NO_TRANSFORM = 3,
  NO_ROOM = 4,
  NOT_AVAILABLE = 5,
  NOTHING_FOUND = 6,
  FILE_REJECTED = 7,
  INTERNAL = 8
};

/// An input that is rejected. what() lists every fault, one per line.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(const std::string& text, FaultCode code = FaultCode::INVALID_VALUE)
      : std::runtime_error(text), code_(code) {}
  FaultCode code() const { return code_; }

 private:
  FaultCode code_;
};

/// Collects all faults of one input, so that a user can mend them at once.
class Faults {
 public:
  /// Keeps the first hundred faults.
  void add(std::string fault, FaultCode code = FaultCode::INVALID_VALUE) {
    if (list_.empty()) code_ = code;
    if (list_.size() < 100) list_.push_back(std::move(fault));
  }
  bool empty() const { return list_.empty(); }
  const std::vector<std::string>& list() const { return list_; }
  /// Returns the faults, one per line.
  std::string text() const;
  /// @throws InvalidInput with text() and the code of the first fault if there is one.
  void throwIfAny() const;

 private:
  std::vector<std::string> list_;
  FaultCode code_{FaultCode::NONE};
};

}  // namespace vegetation_sim
