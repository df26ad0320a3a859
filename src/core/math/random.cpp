// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/core/math/random.h"

namespace vegetation_sim {
namespace {

std::array<std::uint32_t, 4> split(std::uint64_t low, std::uint64_t high) {
  return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32),
          static_cast<std::uint32_t>(high), static_cast<std::uint32_t>(high >> 32)};
}

std::uint64_t draw(std::uint64_t key, std::uint64_t index, std::uint64_t purpose) {
  const auto out = philox(split(index, purpose),
                          {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
  return out[0] | static_cast<std::uint64_t>(out[1]) << 32;
}

}  // namespace

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> c,
                                    std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ULL * c[0], b = 0xCD9E8D57ULL * c[2];
    c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ key[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return c;
}

std::uint64_t Random::bits(std::uint64_t index) const {
  return draw(key_, index, RANDOM_NUMBERS);
}

double Random::uniform(std::uint64_t index) const {
  return uniformOf(bits(index));
}

Random Random::child(std::uint64_t index) const {
  return Random(draw(key_, index, RANDOM_CHILDREN));
}

}  // namespace vegetation_sim
