// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "physics/twin_sweep.h"

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "physics/twin_sweep.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "physics/chain_mean-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

HWY_INLINE float* rowsAt(Rows& rows, std::size_t index, int quantities, int lane) {
  return rows.at(index * static_cast<std::size_t>(quantities)) + lane;
}

// Some trees of one pack.
struct Part {
  TwinStore& store;
  std::size_t pack;
  int lane;

  HWY_INLINE Joints joints(std::size_t joint) const {
    const std::size_t block = pack * store.joints.size() + joint;
    float* work = rowsAt(store.work, joint, W_ROWS, lane);
    float* kept = rowsAt(store.kept, joint, K_ROWS, lane);
    return {rowsAt(store.constants, block, C_ROWS, lane),
            rowsAt(store.state, block, S_ROWS, lane),
            rowsAt(store.loads, block, L_ROWS, lane),
            work,
            nullptr,
            nullptr,
            nullptr,
            store.mean ? kept + K_BIAS * ROW : work + W_BIAS * ROW,
            store.mean ? kept : nullptr,
            store.joints[joint].bar,
            false};
  }
  HWY_INLINE float* onStack(int depth) const {
    return rowsAt(store.stack, static_cast<std::size_t>(depth), P_ROWS, lane);
  }
  HWY_INLINE const float* base(int root) const {
    const std::size_t roots = static_cast<std::size_t>(store.roots);
    return rowsAt(store.bases, pack * roots + static_cast<std::size_t>(root), F_ROWS, lane);
  }
};

HWY_INLINE void outPart(const Part& part, Lanes step) {
  const bool motion = part.store.trace;
  for (std::size_t i = 0; i < part.store.joints.size(); ++i) {
    const TwinJoint& joint = part.store.joints[i];
    const Joints at = part.joints(i);
    const float* parent = joint.root >= 0 ? part.base(joint.root) : part.onStack(joint.depth - 1);
    const Frame frame = outward<false>(at, loadFrame(parent, ROW), step);
    const StoreRows own{part.onStack(joint.depth), ROW};
    if (!joint.leaf) eachRow(frame, own);
    if (!motion) continue;
    const Trace trace = traceOf<false>(at, frame, parent, ROW);
    eachRow(trace, own);
    storeMotion(frame, trace, rowsAt(part.store.motion, i, M_ROWS, part.lane));
  }
}

HWY_INLINE Articulated loadAll(const float* rows) {
  return {load6(rows, P_A), load3(rows, P_B),      load3(rows, P_B + 3), load3(rows, P_B + 6),
          load6(rows, P_M), load3(rows, P_TORQUE), load3(rows, P_FORCE)};
}

HWY_INLINE void storeAll(const Articulated& a, float* rows) {
  store6(a.a, rows, P_A);
  store3(a.bx, rows, P_B);
  store3(a.by, rows, P_B + 3);
  store3(a.bz, rows, P_B + 6);
  store6(a.m, rows, P_M);
  store3(a.torque, rows, P_TORQUE);
  store3(a.force, rows, P_FORCE);
}

HWY_INLINE Articulated sumOf(const Articulated& a, const Articulated& b) {
  return {a.a + b.a, a.bx + b.bx,         a.by + b.by,      a.bz + b.bz,
          a.m + b.m, a.torque + b.torque, a.force + b.force};
}

// Anchors are few: one by one. `next` is one past those of joints up to this one.
HWY_INLINE const AnchorRows* addAnchors(const Part& part, const AnchorRows* next, std::size_t joint,
                                        Articulated& sum) {
  const int width = static_cast<int>(hn::Lanes(Tag()));
  for (; next != part.store.anchors.data(); --next) {
    const AnchorRows& anchor = next[-1];
    if (static_cast<std::size_t>(anchor.slot / ROW) != joint) break;
    const int lane = anchor.slot % ROW - part.lane;
    if (lane < 0 || lane >= width) continue;
    alignas(64) float lanes[P_ROWS][ROW] = {};
    for (int row = 0; row < P_ROWS; ++row) lanes[row][lane] = anchor.value[row];
    sum = sumOf(sum, loadAll(lanes[0]));
  }
  return next;
}

// The children's sum waits on the stack at their parent's depth; the last child begins it.
HWY_INLINE void inwardPart(const Part& part, Lanes step) {
  const AnchorRows* next = part.store.anchors.data() + part.store.anchors.size();
  for (std::size_t i = part.store.joints.size(); i-- > 0;) {
    const TwinJoint& joint = part.store.joints[i];
    Articulated sum = joint.leaf ? nothing() : loadAll(part.onStack(joint.depth));
    next = addAnchors(part, next, i, sum);
    inward(part.joints(i), step, part.store.drag, sum);
    if (joint.root >= 0) continue;
    float* below = part.onStack(joint.depth - 1);
    storeAll(joint.last ? sum : sumOf(loadAll(below), sum), below);
  }
}

HWY_INLINE void lookAheadPart(const Part& part, Lanes step) {
  for (std::size_t i = 0; i < part.store.joints.size(); ++i) {
    const TwinJoint& joint = part.store.joints[i];
    const Ahead parent = joint.root >= 0 ? aheadOfBase(part.base(joint.root), ROW)
                                         : loadAhead(part.onStack(joint.depth - 1), ROW);
    const Ahead own = lookAhead(part.joints(i), parent, step);
    if (!joint.leaf) eachRow(own, StoreRows{part.onStack(joint.depth), ROW});
  }
}

HWY_INLINE void inwardWrenches(const Part& part) {
  const Lanes o = hn::Zero(Tag());
  for (std::size_t i = part.store.joints.size(); i-- > 0;) {
    const TwinJoint& joint = part.store.joints[i];
    const float* own = part.onStack(joint.depth);
    Bias sum{{o, o, o}, {o, o, o}};
    if (!joint.leaf) sum = {load3(own, 0), load3(own, 3)};
    inwardWrench(part.joints(i), sum);
    if (joint.root >= 0) continue;
    float* below = part.onStack(joint.depth - 1);
    if (!joint.last) sum = {load3(below, 0) + sum.torque, load3(below, 3) + sum.force};
    store3(sum.torque, below, 0);
    store3(sum.force, below, 3);
  }
}

HWY_INLINE void settlePart(const Part& part, Lanes step) {
  const Lanes o = hn::Zero(Tag());
  Lanes fastest = o;
  for (std::size_t i = 0; i < part.store.joints.size(); ++i) {
    const TwinJoint& joint = part.store.joints[i];
    const float* below = joint.root >= 0 ? nullptr : part.onStack(joint.depth - 1);
    const Push parent = below ? Push{load3(below, 0), load3(below, 3)} : Push{{o, o, o}, {o, o, o}};
    const Push push = settle(part.joints(i), parent, step, false, fastest);
    if (joint.leaf) continue;
    eachRow(push, StoreRows{part.onStack(joint.depth), ROW});
  }
  hn::StoreU(fastest, Tag(), part.store.fastest + part.lane);
}

void outPack(int pack, float step, TwinStore& store) {
  const int width = static_cast<int>(hn::Lanes(Tag()));
  for (int lane = 0; lane < ROW; lane += width)
    outPart({store, static_cast<std::size_t>(pack), lane}, all(step));
}

void backPack(int pack, float step, TwinStore& store) {
  const int width = static_cast<int>(hn::Lanes(Tag()));
  for (int lane = 0; lane < ROW; lane += width) {
    const Part part{store, static_cast<std::size_t>(pack), lane};
    inwardPart(part, all(step));
    if (store.mean) {
      lookAheadPart(part, all(step));
      inwardWrenches(part);
    }
    settlePart(part, all(step));
  }
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::physics {

HWY_EXPORT(outPack);
HWY_EXPORT(backPack);

void sweepPackOut(int pack, float step, TwinStore& store) {
  HWY_DYNAMIC_DISPATCH(outPack)(pack, step, store);
}

void sweepPackBack(int pack, float step, TwinStore& store) {
  HWY_DYNAMIC_DISPATCH(backPack)(pack, step, store);
}

}  // namespace vegetation_sim::physics
#endif
