// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "physics/chain_sweep.h"

#include <algorithm>

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/chain_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "physics/chain_pass-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

HWY_INLINE Joints jointsAt(const ChainGroup& group, ChainStore& store, int slot) {
  return {store.constants.of(slot, C_ROWS),
          store.state.of(slot, S_ROWS),
          store.loads.empty() ? nullptr : store.loads.of(slot, L_ROWS),
          store.work.of(slot - group.begin, W_ROWS),
          store.grips.empty() ? nullptr : store.grips.of(slot, G_ROWS),
          store.grips.empty() ? nullptr : store.air.of(slot, V_ROWS),
          group.bars,
          group.on_axis};
}

// ---- between parts -----------------------------------------------------------------------------

/// Rows of single joints, ascending by slot, as far as a sweep has come.
template <class One>
struct Singles {
  One *next, *end;

  // Of the vector from `slot` on.
  HWY_INLINE bool any(int slot) const { return next != end && next->slot < slot + width(); }
};

Singles<JointRows> hungOn(ChainGroup& group, std::size_t part, const Level& level) {
  if (part != 0) return {nullptr, nullptr};
  JointRows* const end = group.hung.data() + group.hung.size();
  const auto before = [](const JointRows& a, int slot) { return a.slot < slot; };
  return {std::lower_bound(group.hung.data(), end, level.begin, before), end};
}

Singles<const JointRows> anchorsOn(const ChainStore& store, const Level& level) {
  const JointRows *const begin = store.anchors.data(), *const end = begin + store.anchors.size();
  const auto before = [](const JointRows& a, int slot) { return a.slot < slot; };
  return {std::lower_bound(begin, end, level.begin, before), end};
}

// They are few: one by one, and apart, so that sums without any stay in registers.
template <class One, class Sum>
HWY_NOINLINE void addSingles(int slot, Singles<One>& from, Sum& sum) {
  for (; from.any(slot); ++from.next) {
    alignas(64) float lanes[P_ROWS][ROW] = {};
    for (int row = 0; row < P_ROWS; ++row)
      lanes[row][from.next->slot - slot] = from.next->value[row];
    addTo(sum, [&](int row, Lanes value) HWY_ATTR { return value + hn::LoadU(Tag(), lanes[row]); });
  }
}

template <class One, class Sum>
HWY_INLINE void addAny(int slot, Singles<One>& from, Sum& sum) {
  if (HWY_LIKELY(!from.any(slot))) return;
  Sum held = sum;
  addSingles(slot, from, held);
  sum = held;
}

template <class Each>
HWY_INLINE void handToHung(int slot, Singles<JointRows>& hung, const Each& each) {
  if (HWY_LIKELY(!hung.any(slot))) return;
  alignas(64) float lanes[P_ROWS][ROW] = {};
  each(StoreRows{lanes[0], ROW});
  for (; hung.any(slot); ++hung.next)
    for (int row = 0; row < P_ROWS; ++row)
      hung.next->value[row] = lanes[row][hung.next->slot - slot];
}

void loadBases(const ChainGroup& group, LevelRows& out) {
  for (std::size_t i = 0; i < group.bases.size(); ++i)
    for (int row = 0; row < F_ROWS; ++row)
      out.data()[static_cast<std::size_t>(row * out.room) + i] = group.bases[i].value[row];
}

// What the first level of a part stands on.
void loadHung(const ChainGroup& group, std::size_t part, int rows, LevelRows& out) {
  const std::vector<int>& roots = group.parts[part].roots;
  for (std::size_t i = 0; i < roots.size(); ++i)
    for (int row = 0; row < rows; ++row)
      out.data()[static_cast<std::size_t>(row * out.room) + i] =
          group.hung[static_cast<std::size_t>(roots[i])].value[row];
}

// What the first level of a part passes on to the joints that it hangs on.
void passToStem(const float* from, int room, std::size_t part, int rows, ChainGroup& group) {
  const std::vector<int>& roots = group.parts[part].roots;
  for (std::size_t i = 0; i < roots.size(); ++i)
    for (int row = 0; row < rows; ++row)
      group.hung[static_cast<std::size_t>(roots[i])].value[row] =
          from[static_cast<std::size_t>(row * room) + i];
}

// ---- sweeps ------------------------------------------------------------------------------------

// What of the motion is handed on.
enum class Told { NOTHING, VELOCITY, ALL };

template <Told TOLD>
HWY_INLINE void outPartAs(ChainGroup& group, std::size_t part, Lanes step, ChainStore& store) {
  float *received = store.first.data(), *handed = store.second.data();
  const int room = store.first.room;
  const bool kept = store.mean || !store.grips.empty();
  part == 0 ? loadBases(group, store.first) : loadHung(group, part, F_ROWS, store.first);
  for (const Level& level : group.parts[part].levels) {
    Singles<JointRows> hung = hungOn(group, part, level);
    for (int i = 0; i < level.count; i += width()) {
      const int slot = level.begin + i;
      const Joints at = jointsAt(group, store, slot);
      const Frame frame = outward(at, loadFrame(received + i, room), step, kept);
      const auto pass = [&](const auto& each) HWY_ATTR __attribute__((always_inline)) {
        handOn(level, i, each, room, handed);
        handToHung(slot, hung, each);
      };
      if constexpr (TOLD != Told::NOTHING) {
        const Trace trace = traceOf(received + i, room, at.work);
        if (at.grips) store3(trace.velocity, at.work, W_VELOCITY);
        if (TOLD == Told::ALL && at.grips) store3(trace.position, at.work, W_POSITION);
        if (TOLD == Told::ALL && store.trace)
          storeMotion(frame, trace, store.motion.of(slot - group.begin, M_ROWS));
        pass([&](const auto& put) HWY_ATTR __attribute__((always_inline)) {
          eachRow(frame, put);
          eachRow(trace.velocity, F_VELOCITY, put);
          if constexpr (TOLD == Told::ALL) eachRow(trace.position, F_POSITION, put);
        });
      } else {
        pass([&](const auto& put) HWY_ATTR __attribute__((always_inline)) { eachRow(frame, put); });
      }
    }
    std::swap(received, handed);
  }
}

void outPart(ChainGroup& group, std::size_t part, float step, ChainStore& store) {
  if (store.trace || store.asked)
    outPartAs<Told::ALL>(group, part, all(step), store);
  else if (!store.grips.empty())
    outPartAs<Told::VELOCITY>(group, part, all(step), store);
  else
    outPartAs<Told::NOTHING>(group, part, all(step), store);
}

void gripsOfPart(const ChainGroup& group, std::size_t part, ChainStore& store) {
  for (const Level& level : group.parts[part].levels)
    for (int i = 0; i < level.count; i += width()) {
      const Joints at = jointsAt(group, store, level.begin + i);
      store3(load3(at.work, W_POSITION) + gripArm(at), at.air, V_PLACE);
    }
}

void inPart(ChainGroup& group, std::size_t part, float h, ChainStore& store) {
  const Lanes step = all(h);
  const int room = store.first.room;
  float *own = store.first.data(), *received = store.second.data();
  const std::vector<Level>& levels = group.parts[part].levels;
  for (std::size_t l = levels.size(); l-- > 0;) {
    const Level& level = levels[l];
    Singles<JointRows> hung = hungOn(group, part, level);
    Singles<const JointRows> anchors = anchorsOn(store, level);
    for (int i = 0; i < level.count; i += width()) {
      const int slot = level.begin + i;
      Articulated sum = nothing();
      gatherChildren(level, received, room, i, sum);
      addAny(slot, hung, sum);
      addAny(slot, anchors, sum);
      const Joints at = jointsAt(group, store, slot);
      inward(at, step, store.drag, sum);
      storeAll(sum, own + i, room);
    }
    std::swap(own, received);
  }
  passToStem(received, room, part, P_ROWS, group);
}

void aheadPart(ChainGroup& group, std::size_t part, float h, ChainStore& store) {
  const Lanes step = all(h);
  float *received = store.first.data(), *handed = store.second.data();
  const int room = store.first.room;
  part == 0 ? loadBases(group, store.first) : loadHung(group, part, H_ROWS, store.first);
  bool on_base = part == 0;
  for (const Level& level : group.parts[part].levels) {
    Singles<JointRows> hung = hungOn(group, part, level);
    for (int i = 0; i < level.count; i += width()) {
      const int slot = level.begin + i;
      const Ahead parent =
          on_base ? aheadOfBase(received + i, room) : loadAhead(received + i, room);
      const Joints at = jointsAt(group, store, slot);
      const Ahead own = lookAhead(at, parent, step);
      const auto each = [&](const auto& put) HWY_ATTR { eachRow(own, put); };
      handOn(level, i, each, room, handed);
      handToHung(slot, hung, each);
    }
    on_base = false;
    std::swap(received, handed);
  }
}

void wrenchesOfPart(ChainGroup& group, std::size_t part, ChainStore& store) {
  const int room = store.first.room;
  const Lanes o = hn::Zero(Tag());
  float *own = store.first.data(), *received = store.second.data();
  const std::vector<Level>& levels = group.parts[part].levels;
  for (std::size_t l = levels.size(); l-- > 0;) {
    const Level& level = levels[l];
    Singles<JointRows> hung = hungOn(group, part, level);
    for (int i = 0; i < level.count; i += width()) {
      const int slot = level.begin + i;
      Bias sum{{o, o, o}, {o, o, o}};
      gatherChildren(level, received, room, i, sum);
      addAny(slot, hung, sum);
      const Joints at = jointsAt(group, store, slot);
      inwardWrench(at, sum);
      storeAll(sum, own + i, room);
    }
    std::swap(own, received);
  }
  passToStem(received, room, part, A_ROWS, group);
}

float settlePart(ChainGroup& group, std::size_t part, float h, ChainStore& store) {
  const Lanes step = all(h);
  const int room = store.first.room;
  float *received = store.first.data(), *handed = store.second.data();
  Lanes fastest = hn::Zero(Tag());
  const std::vector<Level>& levels = group.parts[part].levels;
  for (int row = 0; row < A_ROWS; ++row) std::fill_n(received + row * room, levels[0].count, 0.f);
  loadHung(group, part, A_ROWS, store.first);
  for (const Level& level : levels) {
    Singles<JointRows> hung = hungOn(group, part, level);
    for (int i = 0; i < level.count; i += width()) {
      const int slot = level.begin + i;
      const Push parent{load3(received + i, 0, room), load3(received + i, 3, room)};
      const Joints at = jointsAt(group, store, slot);
      const Push push = settle(at, parent, step, store.mean, fastest);
      const auto each = [&](const auto& put) HWY_ATTR { eachRow(push, put); };
      handOn(level, i, each, room, handed);
      handToHung(slot, hung, each);
    }
    std::swap(received, handed);
  }
  return hn::GetLane(hn::MaxOfLanes(Tag(), fastest));
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::physics {

HWY_EXPORT(outPart);
HWY_EXPORT(gripsOfPart);
HWY_EXPORT(inPart);
HWY_EXPORT(aheadPart);
HWY_EXPORT(wrenchesOfPart);
HWY_EXPORT(settlePart);

void sweepOut(ChainGroup& group, std::size_t part, float step, ChainStore& store) {
  HWY_DYNAMIC_DISPATCH(outPart)(group, part, step, store);
}

void placeGrips(const ChainGroup& group, std::size_t part, ChainStore& store) {
  HWY_DYNAMIC_DISPATCH(gripsOfPart)(group, part, store);
}

void sweepIn(ChainGroup& group, std::size_t part, float step, ChainStore& store) {
  HWY_DYNAMIC_DISPATCH(inPart)(group, part, step, store);
}

void sweepAhead(ChainGroup& group, std::size_t part, float step, ChainStore& store) {
  HWY_DYNAMIC_DISPATCH(aheadPart)(group, part, step, store);
}

void sweepWrenches(ChainGroup& group, std::size_t part, ChainStore& store) {
  HWY_DYNAMIC_DISPATCH(wrenchesOfPart)(group, part, store);
}

float sweepSettle(ChainGroup& group, std::size_t part, float step, ChainStore& store) {
  return HWY_DYNAMIC_DISPATCH(settlePart)(group, part, step, store);
}

}  // namespace vegetation_sim::physics
#endif
