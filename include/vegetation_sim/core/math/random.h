// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace vegetation_sim {

/// Philox4x32-10: returns 128 random bits as a pure function of key and counter (Salmon, Moraes,
/// Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011).
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                    std::array<std::uint32_t, 2> key);

/// Third word of Philox's counter: keeps the numbers of a generator apart from the keys of its
/// children.
constexpr std::uint64_t RANDOM_NUMBERS = 0, RANDOM_CHILDREN = 1;

/// Mixes the bits of a counter: a bijection of 32 bits that costs two multiplications (Wellons
/// 2018, "lowbias32"). For millions of items that no state depends on, such as blades.
inline std::uint32_t mix32(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7FEB352DU;
  x ^= x >> 15;
  x *= 0x846CA68BU;
  x ^= x >> 16;
  return x;
}

/// Random numbers of one plant or part of it. Nothing is drawn in sequence: the value of an index
/// does not depend on the order of calls, so levels of detail never change a neighbour.
class Random {
 public:
  explicit Random(std::uint64_t key) : key_(key) {}

  std::uint64_t key() const { return key_; }
  /// Returns the number in [0, 1) that uniform() makes of these bits.
  static double uniformOf(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * (1.0 / 9007199254740992.0);
  }
  /// Returns 64 random bits for `index`.
  std::uint64_t bits(std::uint64_t index) const;
  /// Returns a uniform number in [0, 1).
  double uniform(std::uint64_t index) const;
  /// Returns a uniform number in [low, high).
  double uniform(std::uint64_t index, double low, double high) const {
    return low + (high - low) * uniform(index);
  }
  /// Returns an independent generator for part number `index`.
  Random child(std::uint64_t index) const;

 private:
  std::uint64_t key_;
};

}  // namespace vegetation_sim
