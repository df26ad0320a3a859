// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/hash.h"

#include <cstring>

namespace vegetation_sim {

void Hash::add(std::uint64_t value) {
  for (int i = 0; i < 8; ++i) value_ = (value_ ^ ((value >> (8 * i)) & 0xff)) * 0x100000001b3ULL;
}

void Hash::add(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  add(bits);
}

void Hash::add(const std::string& value) {
  add(static_cast<std::uint64_t>(value.size()));
  for (const char c : value) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
}

}  // namespace vegetation_sim
