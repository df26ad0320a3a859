// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/random_batch.h"

#include "vegetation_sim/core/math/random.h"

// Vectors without arithmetic operators are left out; their processors use the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/math/random_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR
// Without vectors nothing is drawn at once.
std::size_t drawBitsOfMany(const std::uint64_t*, std::size_t, std::uint64_t, std::uint64_t*) {
  return 0;
}
std::size_t drawChildrenOfMany(const std::uint64_t*, const std::uint64_t*, std::size_t,
                               std::uint64_t*) {
  return 0;
}
#else
// Each of the four words of a state is the low half of a lane of 64 bits, so that products need no
// permutation. The high halves hold anything; nothing reads them before the end.
using Tag = hn::ScalableTag<std::uint64_t>;
using Lanes = hn::Vec<Tag>;
using Halves = hn::RepartitionToNarrow<Tag>;

HWY_INLINE Lanes all(std::uint64_t value) {
  return hn::Set(Tag(), value);
}

HWY_INLINE Lanes product(Lanes a, Lanes b) {
  return hn::MulEven(hn::BitCast(Halves(), a), hn::BitCast(Halves(), b));
}

// philox() of counters {index, 0, purpose, 0} in 64 bits each, of which it returns the first half.
// Two vectors go side by side, because one would wait for its products.
struct Pair {
  Lanes first, second;
};

struct State {
  Lanes c0, c1, c2, c3;
};

HWY_INLINE void advance(State& s, Lanes key, Lanes high_key) {
  const Lanes a = product(all(0xD2511F53ULL), s.c0), b = product(all(0xCD9E8D57ULL), s.c2);
  s = {hn::Xor(hn::Xor(hn::ShiftRight<32>(b), s.c1), key), b,
       hn::Xor(hn::Xor(hn::ShiftRight<32>(a), s.c3), high_key), a};
}

HWY_INLINE Lanes bitsOf(const State& s) {
  return hn::Or(hn::And(s.c0, all(0xffffffffULL)), hn::ShiftLeft<32>(s.c1));
}

HWY_INLINE Pair philoxLanes(Pair key, Pair index, std::uint64_t purpose) {
  const Lanes zero = hn::Zero(Tag());
  State s{index.first, hn::ShiftRight<32>(index.first), all(purpose), zero};
  State t{index.second, hn::ShiftRight<32>(index.second), all(purpose), zero};
  Lanes s_high = hn::ShiftRight<32>(key.first), t_high = hn::ShiftRight<32>(key.second);
  for (int round = 0; round < 10; ++round) {
    advance(s, key.first, s_high);
    advance(t, key.second, t_high);
    key.first = key.first + all(0x9E3779B9ULL);
    key.second = key.second + all(0x9E3779B9ULL);
    s_high = s_high + all(0xBB67AE85ULL);
    t_high = t_high + all(0xBB67AE85ULL);
  }
  return {bitsOf(s), bitsOf(t)};
}

HWY_INLINE Pair load(const std::uint64_t* from) {
  return {hn::LoadU(Tag(), from), hn::LoadU(Tag(), from + hn::Lanes(Tag()))};
}

HWY_INLINE void store(const Pair& value, std::uint64_t* to) {
  hn::StoreU(value.first, Tag(), to);
  hn::StoreU(value.second, Tag(), to + hn::Lanes(Tag()));
}

// Both return how many of the numbers they have drawn: whole pairs of vectors.
std::size_t drawBitsOfMany(const std::uint64_t* keys, std::size_t count, std::uint64_t index,
                           std::uint64_t* out) {
  const std::size_t step = 2 * hn::Lanes(Tag());
  std::size_t i = 0;
  for (; i + step <= count; i += step)
    store(philoxLanes(load(keys + i), {all(index), all(index)}, RANDOM_NUMBERS), out + i);
  return i;
}

std::size_t drawChildrenOfMany(const std::uint64_t* keys, const std::uint64_t* indices,
                               std::size_t count, std::uint64_t* out) {
  const std::size_t step = 2 * hn::Lanes(Tag());
  std::size_t i = 0;
  for (; i + step <= count; i += step)
    store(philoxLanes(load(keys + i), load(indices + i), RANDOM_CHILDREN), out + i);
  return i;
}
#endif

}  // namespace vegetation_sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim {

HWY_EXPORT(drawBitsOfMany);
HWY_EXPORT(drawChildrenOfMany);

void drawBits(const std::uint64_t* keys, std::size_t count, std::uint64_t index,
              std::uint64_t* out) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(drawBitsOfMany)(keys, count, index, out);
  for (; i < count; ++i) out[i] = Random(keys[i]).bits(index);
}

void drawChildren(const std::uint64_t* keys, const std::uint64_t* indices, std::size_t count,
                  std::uint64_t* out) {
  std::size_t i = HWY_DYNAMIC_DISPATCH(drawChildrenOfMany)(keys, indices, count, out);
  for (; i < count; ++i) out[i] = Random(keys[i]).child(indices[i]).key();
}

}  // namespace vegetation_sim
#endif
