// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
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

/// What errors show of a value and of the address of a file [letters], and their whole length
/// [bytes]: inputs of any size are rejected, and errors go to consoles and diagnostics.
constexpr std::size_t LONGEST_VALUE = 60, LONGEST_ADDRESS = 200, LONGEST_ERROR = 4096;
/// Returns a text, or its first `most` letters and "...".
std::string shortened(const std::string& text, std::size_t most = LONGEST_VALUE);
/// Returns 'value', shortened.
std::string inQuotes(const std::string& value, std::size_t most = LONGEST_VALUE);

/// An input that is rejected. what() lists the faults, one per line, and is shortened to
/// LONGEST_ERROR.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(const std::string& text, FaultCode code = FaultCode::INVALID_VALUE)
      : std::runtime_error(shortened(text, LONGEST_ERROR)), code_(code) {}
  FaultCode code() const { return code_; }

 private:
  FaultCode code_;
};

/// Collects all faults of one input, so that a user can mend them at once.
class Faults {
 public:
  /// Keeps the first hundred faults, each shortened to LONGEST_ERROR.
  void add(const std::string& fault, FaultCode code = FaultCode::INVALID_VALUE) {
    if (list_.empty()) code_ = code;
    if (!isFull()) list_.push_back(shortened(fault, LONGEST_ERROR));
  }
  bool empty() const { return list_.empty(); }
  /// Whether no more faults are kept.
  bool isFull() const { return list_.size() >= 100; }
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
