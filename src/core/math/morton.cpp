// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/morton.h"

#include <algorithm>
#include <cmath>

namespace vegetation_sim {
namespace {

constexpr double ORIGIN = -2e7;           // of the Morton cells [m], beyond all landscapes
constexpr double LAST_CELL = 67108863.0;  // 2^26 - 1; a cell is a square of 1 m

// Puts a zero bit before each bit.
std::uint64_t spreadBits(std::uint64_t x) {
  x = (x | x << 16) & 0x0000ffff0000ffffULL;
  x = (x | x << 8) & 0x00ff00ff00ff00ffULL;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fULL;
  x = (x | x << 2) & 0x3333333333333333ULL;
  return (x | x << 1) & 0x5555555555555555ULL;
}

}  // namespace

std::uint64_t mortonKey(double x, double y) {
  const auto cell = [](double at) {
    return static_cast<std::uint64_t>(std::clamp(std::floor(at - ORIGIN), 0.0, LAST_CELL));
  };
  return spreadBits(cell(x)) | spreadBits(cell(y)) << 1;
}

}  // namespace vegetation_sim
