// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/tree/motion/batch_poser.h"

#include <algorithm>

#include "vegetation_sim/core/math/math.h"
#include "wind/sampling/batch_wind.h"

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/motion/batch_poser.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "tree/motion/batch_carry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

HWY_INLINE LanesQuat localRotation(const BatchTree& tree, const FloatWind& wind, float weight,
                                   int i) {
  const LanesQuat rest{load(tree.r0, i), load(tree.r1, i), load(tree.r2, i), load(tree.r3, i)};
  Lanes a = hn::Zero(Tag()), b = a;
  const bool swing = tree.joint_model == JointModel::SWING;
  if (weight > 0.f) {
    Lanes3 v = windAt(wind, {load(tree.x, i), load(tree.y, i), load(tree.z, i)});
    a = load(tree.ax, i) * v.x + load(tree.ay, i) * v.y + load(tree.az, i) * v.z;
    b = load(tree.bx, i) * v.x + load(tree.by, i) * v.y + load(tree.bz, i) * v.z;
    if (tree.drag == Drag::QUADRATIC) {
      const Lanes speed = hn::Sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
      const Lanes factor = speed * all(1.f / tree.reference_speed);
      a = a * factor;
      b = b * factor;
    }
  } else if (swing) {
    return rest;
  }
  return swing ? swingJoint(rest, a, b, all(weight)) : paperJoint(rest, a, b, all(weight));
}

// The last vector of a group overlaps the next group, which is written after it.
void poseGroup(const BatchTree& tree, const FloatWind& wind, const BatchGroup& group, float weight,
               bool bears, BatchPoses& out) {
  const int step = static_cast<int>(hn::Lanes(Tag()));
  for (int i = group.begin; i < group.end; i += step) {
    const LanesQuat local = localRotation(tree, wind, weight, i);
    carry(parentsOf(tree, group, out, i), local, load(tree.h, i), bears, i, out);
  }
}

// Poses a group for given bends.
void poseBends(const BatchTree& tree, const BatchBends& bends, const BatchGroup& group,
               BatchPoses& out) {
  const int step = static_cast<int>(hn::Lanes(Tag()));
  const bool bears = group.bears_depth < MAX_DEPTHS;
  for (int i = group.begin; i < group.end; i += step) {
    const LanesQuat rest{load(tree.r0, i), load(tree.r1, i), load(tree.r2, i), load(tree.r3, i)};
    const LanesQuat local = swingJoint(rest, load(bends.first, i), load(bends.second, i), all(1.f));
    carry(parentsOf(tree, group, out, i), local, load(tree.h, i), bears, i, out);
  }
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::forest {

HWY_EXPORT(poseGroup);
HWY_EXPORT(poseBends);

Pose BatchPoses::at(int branch) const {
  const auto i = static_cast<std::size_t>(branch);
  return {Vec3(x[i], y[i], z[i]), Quat{qw[i], qx[i], qy[i], qz[i]}};
}

namespace {

float narrow(double x) {
  return static_cast<float>(x);
}

void setRest(const Branch& branch, JointModel model, std::size_t i, BatchTree& out) {
  Quat rest = branch.turn;
  if (model == JointModel::PAPER) {
    const SinCos t = sinCos(0.5 * branch.theta), p = sinCos(0.5 * branch.phi);
    rest = {t.cos, t.sin, p.cos, p.sin};
  }
  out.r0[i] = narrow(rest.w);
  out.r1[i] = narrow(rest.x);
  out.r2[i] = narrow(rest.y);
  out.r3[i] = narrow(rest.z);
}

// Never shrinks, because poses are reused for trees of all sizes.
void grow(std::size_t n, std::initializer_list<std::vector<float>*> arrays) {
  for (std::vector<float>* array : arrays)
    if (array->size() < n) array->resize(n);
}

BatchGroup batchGroup(const Group& group, const std::vector<std::int32_t>& parent) {
  BatchGroup out{group.begin, group.end, group.depth,
                 parent[static_cast<std::size_t>(group.begin)]};
  for (int i = group.begin; i < group.end; ++i)
    if (parent[static_cast<std::size_t>(i)] != out.first_parent + i - group.begin)
      out.first_parent = -1;
  // A vector that starts at the slot of the ground would exceed the end.
  if (group.begin == 0) out.first_parent = -1;
  return out;
}

// Marks the groups whose poses other groups collect, and forgets the parents that none reads, since
// whole vectors reach into the next group.
void markBearers(BatchTree& tree) {
  std::vector<int> bears(tree.parent.size(), MAX_DEPTHS);
  for (const BatchGroup& group : tree.groups)
    for (int i = group.begin; i < group.end; ++i) {
      std::int32_t& parent = tree.parent[static_cast<std::size_t>(i)];
      if (group.first_parent >= 0)
        parent = 0;
      else if (group.begin > 0 && group.depth < bears[static_cast<std::size_t>(parent)])
        bears[static_cast<std::size_t>(parent)] = group.depth;
    }
  for (BatchGroup& group : tree.groups) {
    group.bears_depth = *std::min_element(bears.begin() + group.begin, bears.begin() + group.end);
    if (group.bears_depth < MAX_DEPTHS) tree.bearers = static_cast<std::size_t>(group.end);
  }
}

void setGround(std::size_t slot, BatchPoses& out) {
  out.x[slot] = out.y[slot] = out.z[slot] = 0.f;
  out.qw[slot] = 1.f;
  out.qx[slot] = out.qy[slot] = out.qz[slot] = 0.f;
}

}  // namespace

void narrowPoses(const std::vector<Pose>& poses, BatchPoses& out) {
  out.count = static_cast<int>(poses.size());
  for (std::vector<float>* part : {&out.x, &out.y, &out.z, &out.qw, &out.qx, &out.qy, &out.qz})
    part->resize(std::max(part->size(), poses.size() + BatchPoser::PADDING));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3& at = poses[i].position;
    const Quat& turn = poses[i].orientation;
    out.x[i] = static_cast<float>(at.x());
    out.y[i] = static_cast<float>(at.y());
    out.z[i] = static_cast<float>(at.z());
    out.qw[i] = static_cast<float>(turn.w);
    out.qx[i] = static_cast<float>(turn.x);
    out.qy[i] = static_cast<float>(turn.y);
    out.qz[i] = static_cast<float>(turn.z);
  }
}

BatchPoser::BatchPoser(const Tree& tree) {
  const std::size_t n = tree.skeleton.branches.size(), size = n + PADDING;
  BatchTree& t = tree_;
  // The ground has the last slot, which no vector of the last group reaches.
  const auto ground = static_cast<std::int32_t>(size - 1);
  t.parent.assign(size, 0);
  grow(size, {&t.h, &t.x, &t.y, &t.z, &t.r0, &t.r1, &t.r2, &t.r3});
  grow(size, {&t.ax, &t.ay, &t.az, &t.bx, &t.by, &t.bz});
  for (std::size_t i = 0; i < n; ++i) {
    const Branch& branch = tree.skeleton.branches[i];
    const Response& response = tree.response[i];
    t.parent[i] = branch.parent >= 0 ? branch.parent : ground;
    t.h[i] = narrow(branch.h);
    t.x[i] = narrow(branch.rest.position.x());
    t.y[i] = narrow(branch.rest.position.y());
    t.z[i] = narrow(branch.rest.position.z());
    setRest(branch, tree.joint_model, i, t);
    t.ax[i] = narrow(response.first.x());
    t.ay[i] = narrow(response.first.y());
    t.az[i] = narrow(response.first.z());
    t.bx[i] = narrow(response.second.x());
    t.by[i] = narrow(response.second.y());
    t.bz[i] = narrow(response.second.z());
  }
  for (const Group& group : tree.skeleton.groups) t.groups.push_back(batchGroup(group, t.parent));
  markBearers(t);
  t.joint_model = tree.joint_model;
  t.drag = tree.drag;
  t.reference_speed = narrow(tree.reference_speed);
  t.reach = tree.skeleton.reach + 1e-3;  // farther than any base, rounding included
}

void BatchPoser::ready(BatchPoses& out) const {
  const std::size_t size = tree_.parent.size();
  grow(size, {&out.x, &out.y, &out.z, &out.qw, &out.qx, &out.qy, &out.qz});
  grow(FRAME * (tree_.bearers + PADDING), {&out.frames});
  setGround(size - 1, out);
  out.count = 0;
}

void BatchPoser::pose(const wind::Instant& wind, const Weights& weights, int depths,
                      BatchPoses& out) const {
  ready(out);
  const FloatWind narrowed(wind, tree_.reach);
  for (const BatchGroup& group : tree_.groups) {
    if (group.depth >= depths) break;
    const float weight = narrow(weights[static_cast<std::size_t>(group.depth)]);
    const bool bears = group.bears_depth < depths;
    HWY_DYNAMIC_DISPATCH(poseGroup)(tree_, narrowed, group, weight, bears, out);
    out.count = group.end;
  }
}

void BatchPoser::pose(const BatchBends& bends, BatchPoses& out) const {
  ready(out);
  for (const BatchGroup& group : tree_.groups) {
    HWY_DYNAMIC_DISPATCH(poseBends)(tree_, bends, group, out);
    out.count = group.end;
  }
}

}  // namespace vegetation_sim::forest
#endif
