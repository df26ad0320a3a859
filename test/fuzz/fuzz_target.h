// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace vegetation_sim::fuzz {

/// One kind of untrusted input, and the code of the product that reads it.
struct Target {
  const char* name;
  const char* covers;  ///< one line
  /// Decodes the bytes, applies what they say, and uses the result once, as a node or a display
  /// would. Input that the product rejects is no fault; everything that escapes is.
  void (*run)(std::string_view input);
  /// Returns valid inputs from which a fuzzer starts.
  std::vector<std::string> (*seeds)();
};

/// All targets, in the order of the documentation.
const std::vector<Target>& allTargets();
/// @throws std::invalid_argument for an unknown name, with the names that are known.
const Target& findTarget(const std::string& name);

/// A result that the product must never have, such as a pose that is not finite.
struct BrokenPromise : std::logic_error {
  using std::logic_error::logic_error;
};

/// Part of an input: what it is, and its bytes.
struct Piece {
  int kind{0};
  std::string_view bytes;
};
constexpr std::size_t MOST_PIECES = 24;

/// Splits an input into pieces: a byte for the kind, two for the length (the lower one first), and
/// the bytes. The last piece ends with the input.
std::vector<Piece> splitPieces(std::string_view input);
/// Returns a piece as splitPieces() reads it.
std::string pieceOf(int kind, std::string_view bytes);

/// Reads numbers from bytes; beyond the end all are 0.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : bytes_(bytes) {}
  bool empty() const { return bytes_.empty(); }
  std::uint8_t byte();
  std::uint16_t word() {
    const int low = byte();  // first, which an expression of both calls would not guarantee
    return static_cast<std::uint16_t>(low | byte() << 8);
  }
  /// Any double, NaN and infinity included.
  double real();
  /// One of 65536 values in equal steps.
  double between(double low, double high) { return low + (high - low) * word() / 65535.0; }

 private:
  std::string_view bytes_;
};

}  // namespace vegetation_sim::fuzz
