// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/batch_step/chain_sweep.h"

#include <algorithm>

// Vectors without arithmetic operators are left out; their processors use the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dynamics/batch_step/chain_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "dynamics/batch_step/chain_pass-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

HWY_INLINE Joints jointsAt(const ChainGroup& group, ChainStore& store, int slot) {
  float* work = store.scratch->work.of(slot - group.begin, group.workRows());
  float* kept = store.scratch->kept.of(slot - group.begin, K_ROWS);
  return {store.constants.of(slot, store.constant_rows),
          store.state.of(slot, S_ROWS),
          store.loads.empty() ? nullptr : store.loads.of(slot, L_ROWS),
          work,
          store.grips.empty() ? nullptr : store.grips.of(slot, G_ROWS),
          store.beside.empty() ? nullptr : store.beside.of(slot, B_ROWS),
          store.grips.empty() ? nullptr : store.air.of(slot, V_ROWS),
          store.mean ? kept + K_BIAS * ROW : work + W_BIAS * ROW,
          store.mean ? kept : nullptr,
          group.bars,
          group.on_axis};
}

// Anchors are few, so they are added one by one, in a function of its own that keeps other sums in
// registers.
HWY_NOINLINE const AnchorRows* addAnchors(const AnchorRows* next, const AnchorRows* end, int slot,
                                          Articulated& sum) {
  for (; next != end && next->slot < slot + width(); ++next) {
    alignas(64) float lanes[P_ROWS][ROW] = {};
    for (int row = 0; row < P_ROWS; ++row) lanes[row][next->slot - slot] = next->value[row];
    addTo(sum, [&](int row, Lanes value) HWY_ATTR { return value + hn::LoadU(Tag(), lanes[row]); });
  }
  return next;
}

// ---- sweeps ------------------------------------------------------------------------------------

void loadBases(const ChainGroup& group, LevelRows& out) {
  for (std::size_t i = 0; i < group.bases.size(); ++i)
    for (int row = 0; row < F_ROWS; ++row)
      out.data()[static_cast<std::size_t>(row * out.room) + i] = group.bases[i].value[row];
}

// The part of the motion that parents pass to their children.
enum class Passed { NOTHING, VELOCITY, ALL };

template <Passed PASSED, bool PREDICTED>
HWY_INLINE void outGroupAs(const ChainGroup& group, Lanes step, ChainStore& store) {
  float *received = store.scratch->first.data(), *handed = store.scratch->second.data();
  const int room = store.scratch->first.room;
  loadBases(group, store.scratch->first);
  for (const Level& level : group.levels) {
    for (int i = 0; i < level.count; i += width()) {
      const Joints at = jointsAt(group, store, level.begin + i);
      const Frame frame = outward<PREDICTED>(at, loadFrame(received + i, room), step);
      if constexpr (PASSED != Passed::NOTHING) {
        const Trace trace = traceOf<PREDICTED>(at, frame, received + i, room);
        const auto each = [&](const auto& put) HWY_ATTR __attribute__((always_inline)) {
          eachRow(frame, put);
          eachRow(trace.velocity, F_VELOCITY, put);
          if constexpr (PASSED == Passed::ALL) eachRow(trace.position, F_POSITION, put);
          if constexpr (PREDICTED) eachRow(trace.spin, F_NOW, put);
        };
        if (at.grips) keepGrip(at, frame, trace);
        if (PASSED == Passed::ALL && store.asked)
          store3(trace.position + gripArm(at, frame),
                 store.scratch->places.of(level.begin - group.begin + i, V_ROWS), 0);
        if (PASSED == Passed::ALL && store.trace)
          storeMotion(frame, trace,
                      store.scratch->motion.of(level.begin - group.begin + i, M_ROWS));
        passOn(level, i, each, room, handed);
      } else {
        passOn(
            level, i, [&](const auto& put) HWY_ATTR { eachRow(frame, put); }, room, handed);
      }
    }
    std::swap(received, handed);
  }
}

template <bool PREDICTED>
HWY_INLINE void outGroupAt(const ChainGroup& group, Lanes step, ChainStore& store) {
  if (store.trace || store.asked)
    outGroupAs<Passed::ALL, PREDICTED>(group, step, store);
  else if (!store.grips.empty())
    outGroupAs<Passed::VELOCITY, PREDICTED>(group, step, store);
  else
    outGroupAs<Passed::NOTHING, PREDICTED>(group, step, store);
}

void outGroup(const ChainGroup& group, float step, ChainStore& store) {
  store.predicted ? outGroupAt<true>(group, all(step), store)
                  : outGroupAt<false>(group, all(step), store);
}

void inwardGroup(const ChainGroup& group, float h, ChainStore& store) {
  const Lanes step = all(h);
  const int room = store.scratch->first.room;
  const AnchorRows *const begin = store.anchors.data(), *const end = begin + store.anchors.size();
  float *own = store.scratch->first.data(), *received = store.scratch->second.data();
  for (std::size_t l = group.levels.size(); l-- > 0;) {
    const Level& level = group.levels[l];
    const AnchorRows* next = std::lower_bound(
        begin, end, level.begin, [](const AnchorRows& a, int slot) { return a.slot < slot; });
    for (int i = 0; i < level.count; i += width()) {
      Articulated sum = nothing();
      gatherChildren(level, received, room, i, sum);
      if (HWY_UNLIKELY(next != end && next->slot < level.begin + i + width())) {
        Articulated held = sum;
        next = addAnchors(next, end, level.begin + i, held);
        sum = held;
      }
      inward(jointsAt(group, store, level.begin + i), step, store.drag, sum);
      storeAll(sum, own + i, room);
    }
    std::swap(own, received);
  }
}

void predictBiasGroup(const ChainGroup& group, float h, ChainStore& store) {
  const Lanes step = all(h);
  float *received = store.scratch->first.data(), *handed = store.scratch->second.data();
  const int room = store.scratch->first.room;
  loadBases(group, store.scratch->first);
  bool root = true;
  for (const Level& level : group.levels) {
    for (int i = 0; i < level.count; i += width()) {
      const NextMotion parent =
          root ? nextMotionOfBase(received + i, room) : loadNextMotion(received + i, room);
      const NextMotion own = predictBias(jointsAt(group, store, level.begin + i), parent, step);
      passOn(
          level, i, [&](const auto& put) HWY_ATTR { eachRow(own, put); }, room, handed);
    }
    root = false;
    std::swap(received, handed);
  }
}

void inwardWrenches(const ChainGroup& group, ChainStore& store) {
  const int room = store.scratch->first.room;
  const Lanes o = hn::Zero(Tag());
  float *own = store.scratch->first.data(), *received = store.scratch->second.data();
  for (std::size_t l = group.levels.size(); l-- > 0;) {
    const Level& level = group.levels[l];
    for (int i = 0; i < level.count; i += width()) {
      Bias sum{{o, o, o}, {o, o, o}};
      gatherChildren(level, received, room, i, sum);
      inwardWrench(jointsAt(group, store, level.begin + i), sum);
      storeAll(sum, own + i, room);
    }
    std::swap(own, received);
  }
}

float stepGroupJoints(const ChainGroup& group, float h, ChainStore& store) {
  const Lanes step = all(h);
  const int room = store.scratch->first.room;
  float *received = store.scratch->first.data(), *handed = store.scratch->second.data();
  Lanes fastest = hn::Zero(Tag());
  for (int row = 0; row < A_ROWS; ++row)
    std::fill_n(received + row * room, group.levels[0].count, 0.f);
  for (const Level& level : group.levels) {
    for (int i = 0; i < level.count; i += width()) {
      const Push parent{load3(received + i, 0, room), load3(received + i, 3, room)};
      const Push push =
          stepJoint(jointsAt(group, store, level.begin + i), parent, step, store.averages, fastest);
      passOn(
          level, i, [&](const auto& put) HWY_ATTR { eachRow(push, put); }, room, handed);
    }
    std::swap(received, handed);
  }
  return hn::GetLane(hn::MaxOfLanes(Tag(), fastest));
}

float backGroup(const ChainGroup& group, float h, ChainStore& store) {
  inwardGroup(group, h, store);
  if (store.mean) {
    predictBiasGroup(group, h, store);
    inwardWrenches(group, store);
  }
  return stepGroupJoints(group, h, store);
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::physics {

HWY_EXPORT(outGroup);
HWY_EXPORT(backGroup);

void sweepOut(const ChainGroup& group, float step, ChainStore& store) {
  HWY_DYNAMIC_DISPATCH(outGroup)(group, step, store);
}

float sweepBack(const ChainGroup& group, float step, ChainStore& store) {
  return HWY_DYNAMIC_DISPATCH(backGroup)(group, step, store);
}

}  // namespace vegetation_sim::physics
#endif
