// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/state/tree_hashes.h"

namespace vegetation_sim::forest {
namespace {

// Returns a bijection of 64 bits in which each depends on all (the finalizer of SplitMix64), so
// that differences of two trees do not cancel in the sum.
std::uint64_t mixBits(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ x >> 27) * 0x94d049bb133111ebULL;
  return x ^ x >> 31;
}

}  // namespace

std::uint64_t TreeHashes::sum() const {
  std::uint64_t out = 0;
  for (const auto& entry : hashes_) out += mixBits(entry.second.value());
  return out;
}

}  // namespace vegetation_sim::forest
