// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
// Passing of values between a vector of parents and their children in the next level. Included once
// per instruction set.

#if defined(VEGETATION_SIM_PHYSICS_CHAIN_PASS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_PHYSICS_CHAIN_PASS_INL_H_
#undef VEGETATION_SIM_PHYSICS_CHAIN_PASS_INL_H_
#else
#define VEGETATION_SIM_PHYSICS_CHAIN_PASS_INL_H_
#endif

#include "dynamics/batch_step/chain_levels.h"
#include "dynamics/batch_step/chain_mean-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

using Places = hn::RebindToSigned<Tag>;

HWY_INLINE int width() {
  return static_cast<int>(hn::Lanes(Tag()));
}

// Returns which of the joints from `joint` on have a child of this rank.
HWY_INLINE auto haveChild(const std::int32_t* first) {
  const Places d;
  return hn::LoadU(d, first) < hn::LoadU(d, first + 1);
}

// Writes what joints of a vector pass to their children of one rank. It may overwrite the start of
// the next vector's output, but not the next rank.
struct ChildWriter {
  float* target;
  int room;
  int count;
  bool whole;
  hn::Vec<Places> order;

  HWY_INLINE void operator()(int row, Lanes value) const {
    const Tag d;
    const Lanes sorted = hn::TableLookupLanes(value, hn::IndicesFromVec(d, order));
    if (HWY_LIKELY(whole))
      hn::StoreU(sorted, d, target + row * room);
    else
      hn::BlendedStore(sorted, hn::FirstN(d, static_cast<std::size_t>(count)), d,
                       target + row * room);
  }
};

// `each(put)` calls put(row, value) for what the parents from `parent` on pass to their children.
template <class Each>
HWY_INLINE void passOn(const Level& level, int parent, const Each& each, int room, float* to) {
  for (const ChildRank& child_rank : level.child_ranks) {
    if (parent >= child_rank.parents) continue;
    const std::int32_t* first = child_rank.first.data() + parent;
    const int count = first[width()] - first[0];
    if (count == 0) continue;
    float* target = to + first[0];
    if (count == width()) {
      each(StoreRows{target, room});
      continue;
    }
    const auto order = hn::Compress(hn::Iota(Places(), 0), haveChild(first));
    each(ChildWriter{target, room, count, first[0] + width() <= child_rank.end, order});
  }
}

// `add(row, sum)` returns the sum plus the value in that row.
template <class Add>
HWY_INLINE void addTo(Lanes3& sum, int row, const Add& add) {
  sum = {add(row, sum.x), add(row + 1, sum.y), add(row + 2, sum.z)};
}

template <class Add>
HWY_INLINE void addTo(Symmetric& sum, int row, const Add& add) {
  sum = {add(row, sum.xx),     add(row + 1, sum.xy), add(row + 2, sum.xz),
         add(row + 3, sum.yy), add(row + 4, sum.yz), add(row + 5, sum.zz)};
}

template <class Add>
HWY_INLINE void addTo(Articulated& sum, const Add& add) {
  addTo(sum.a, P_A, add);
  addTo(sum.bx, P_B, add);
  addTo(sum.by, P_B + 3, add);
  addTo(sum.bz, P_B + 6, add);
  addTo(sum.m, P_M, add);
  addTo(sum.torque, P_TORQUE, add);
  addTo(sum.force, P_FORCE, add);
}

template <class Add>
HWY_INLINE void addTo(Bias& sum, const Add& add) {
  addTo(sum.torque, 0, add);
  addTo(sum.force, 3, add);
}

// Children of one rank of a vector of joints.
struct Siblings {
  const float* source;
  hn::Vec<Places> places;
  hn::Mask<Tag> present;

  HWY_INLINE Lanes at(int offset) const {
    const Tag d;
    return hn::IfThenElseZero(present, hn::TableLookupLanes(hn::LoadU(d, source + offset),
                                                            hn::IndicesFromVec(d, places)));
  }
};

template <int RANKS, class Sum>
HWY_INLINE void addSiblings(const Siblings* of, int room, Sum& sum) {
  addTo(sum, [&](int row, Lanes value) HWY_ATTR {
    for (int rank = 0; rank < RANKS; ++rank) value = value + of[rank].at(row * room);
    return value;
  });
}

// Finds the next rank from `child_rank` on that a vector of joints has. Returns false if there is
// none.
HWY_INLINE bool nextRank(const Level& level, const float* from, int parent, std::size_t& child_rank,
                         Siblings& out) {
  for (; child_rank < level.child_ranks.size(); ++child_rank) {
    if (parent >= level.child_ranks[child_rank].parents) continue;
    const std::int32_t* first = level.child_ranks[child_rank].first.data() + parent;
    if (first[width()] == first[0]) continue;
    out.source = from + first[0];
    out.places = hn::LoadU(Places(), first) - hn::Set(Places(), first[0]);
    out.present = hn::RebindMask(Tag(), haveChild(first));
    ++child_rank;
    return true;
  }
  return false;
}

// Sums from children to parents, rank by rank; two ranks at once avoid a round trip through memory.
template <class Sum>
HWY_INLINE void gatherChildren(const Level& level, const float* from, int room, int parent,
                               Sum& sum) {
  std::size_t child_rank = 0;
  Siblings found[2];
  while (nextRank(level, from, parent, child_rank, found[0])) {
    if (nextRank(level, from, parent, child_rank, found[1])) {
      addSiblings<2>(found, room, sum);
    } else {
      addSiblings<1>(found, room, sum);
      break;
    }
  }
}

HWY_INLINE void storeAll(const Bias& bias, float* rows, int room) {
  store3(bias.torque, rows, 0, room);
  store3(bias.force, rows, 3, room);
}

HWY_INLINE void storeAll(const Articulated& a, float* rows, int room) {
  store6(a.a, rows, P_A, room);
  store3(a.bx, rows, P_B, room);
  store3(a.by, rows, P_B + 3, room);
  store3(a.bz, rows, P_B + 6, room);
  store6(a.m, rows, P_M, room);
  store3(a.torque, rows, P_TORQUE, room);
  store3(a.force, rows, P_FORCE, room);
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
