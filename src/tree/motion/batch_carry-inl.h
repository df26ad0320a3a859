// Forward kinematics on vectors of floats; included once per instruction set.

#if defined(VEGETATION_SIM_FOREST_BATCH_CARRY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VEGETATION_SIM_FOREST_BATCH_CARRY_INL_H_
#undef VEGETATION_SIM_FOREST_BATCH_CARRY_INL_H_
#else
#define VEGETATION_SIM_FOREST_BATCH_CARRY_INL_H_
#endif

#include "tree/motion/batch_joint-inl.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

HWY_INLINE Lanes load(const std::vector<float>& from, int i) {
  return hn::LoadU(Tag(), from.data() + i);
}

HWY_INLINE void store(Lanes value, std::vector<float>& to, int i) {
  hn::StoreU(value, Tag(), to.data() + i);
}

// Frames of the parents of branches i, i + 1, ...
struct Parents {
  Lanes x, y, z;
  LanesQuat q;
};

#if HWY_TARGET != HWY_SCALAR
struct Quads {
  Lanes a, b, c, d;
};

// Transposes each block of four lanes.
HWY_INLINE Quads transposed(const Quads& q) {
  const Tag tag;
  const hn::RepartitionToWide<hn::RebindToUnsigned<Tag>> pairs;
  const auto ab_low = hn::BitCast(pairs, hn::InterleaveLower(tag, q.a, q.b));
  const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(tag, q.a, q.b));
  const auto cd_low = hn::BitCast(pairs, hn::InterleaveLower(tag, q.c, q.d));
  const auto cd_high = hn::BitCast(pairs, hn::InterleaveUpper(tag, q.c, q.d));
  return {hn::BitCast(tag, hn::InterleaveLower(pairs, ab_low, cd_low)),
          hn::BitCast(tag, hn::InterleaveUpper(pairs, ab_low, cd_low)),
          hn::BitCast(tag, hn::InterleaveLower(pairs, ab_high, cd_high)),
          hn::BitCast(tag, hn::InterleaveUpper(pairs, ab_high, cd_high))};
}

// Blocks of four floats at rows[0], rows[4], ... of the frames.
template <class D>
HWY_INLINE hn::Vec<D> loadBlocks(D tag, const float* frames, const std::int32_t* rows) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(tag, frames + BatchPoser::FRAME * static_cast<std::ptrdiff_t>(rows[0]));
  } else {
    const hn::Half<D> half;
    return hn::Combine(tag, loadBlocks(half, frames, rows + hn::MaxLanes(half)),
                       loadBlocks(half, frames, rows));
  }
}

template <class D>
HWY_INLINE void storeBlocks(D tag, hn::Vec<D> value, float* frames) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    hn::StoreU(value, tag, frames);
  } else {
    const hn::Half<D> half;
    storeBlocks(half, hn::LowerHalf(half, value), frames);
    storeBlocks(half, hn::UpperHalf(half, value), frames + BatchPoser::FRAME * hn::MaxLanes(half));
  }
}

HWY_INLINE Quads loadQuads(const float* frames, const std::int32_t* rows) {
  const Tag tag;
  return transposed({loadBlocks(tag, frames, rows), loadBlocks(tag, frames, rows + 1),
                     loadBlocks(tag, frames, rows + 2), loadBlocks(tag, frames, rows + 3)});
}

HWY_INLINE void storeQuads(const Quads& columns, float* frames) {
  const Tag tag;
  const Quads rows = transposed(columns);
  storeBlocks(tag, rows.a, frames);
  storeBlocks(tag, rows.b, frames + BatchPoser::FRAME);
  storeBlocks(tag, rows.c, frames + 2 * BatchPoser::FRAME);
  storeBlocks(tag, rows.d, frames + 3 * BatchPoser::FRAME);
}

// Loads of whole rows and their transposition take a quarter of the time of seven gathers.
HWY_INLINE Parents collectParents(const BatchTree& tree, const BatchPoses& out, int i) {
  const float* frames = out.frames.data();
  const std::int32_t* rows = tree.parent.data() + i;
  const Quads low = loadQuads(frames, rows), high = loadQuads(frames + 4, rows);
  return {low.a, low.b, low.c, {low.d, high.a, high.b, high.c}};
}

// Copies poses that later groups collect.
HWY_INLINE void keepFrames(const Parents& pose, int i, BatchPoses& out) {
  float* frames = out.frames.data() + BatchPoser::FRAME * static_cast<std::ptrdiff_t>(i);
  storeQuads({pose.x, pose.y, pose.z, pose.q.w}, frames);
  storeQuads({pose.q.x, pose.q.y, pose.q.z, pose.q.z}, frames + 4);
}
#else
HWY_INLINE void keepFrames(const Parents&, int, BatchPoses&) {}
#endif

HWY_INLINE Parents gatherParents(const BatchTree& tree, const BatchPoses& out, int i) {
  const auto parent = hn::LoadU(hn::RebindToSigned<Tag>(), tree.parent.data() + i);
  const auto gather = [&](const std::vector<float>& from)
                          HWY_ATTR { return hn::GatherIndex(Tag(), from.data(), parent); };
  return {gather(out.x),
          gather(out.y),
          gather(out.z),
          {gather(out.qw), gather(out.qx), gather(out.qy), gather(out.qz)}};
}

HWY_INLINE Parents loadParents(const BatchPoses& out, int parent) {
  return {load(out.x, parent),
          load(out.y, parent),
          load(out.z, parent),
          {load(out.qw, parent), load(out.qx, parent), load(out.qy, parent), load(out.qz, parent)}};
}

HWY_INLINE void carry(const Parents& parent, const LanesQuat& local, Lanes h, bool bears, int i,
                      BatchPoses& out) {
  const LanesQuat& q = parent.q;
  const Lanes two = all(2.f);
  const Parents pose{parent.x + h * (two * (q.x * q.z + q.w * q.y)),
                     parent.y + h * (two * (q.y * q.z - q.w * q.x)),
                     parent.z + h * (all(1.f) - two * (q.x * q.x + q.y * q.y)), multiply(q, local)};
  store(pose.x, out.x, i);
  store(pose.y, out.y, i);
  store(pose.z, out.z, i);
  store(pose.q.w, out.qw, i);
  store(pose.q.x, out.qx, i);
  store(pose.q.y, out.qy, i);
  store(pose.q.z, out.qz, i);
  if (bears) keepFrames(pose, i, out);
}

// Parents of continued limbs are consecutive. The ground below the first group has no row.
HWY_INLINE Parents parentsOf(const BatchTree& tree, const BatchGroup& group, const BatchPoses& out,
                             int i) {
  if (group.first_parent >= 0) return loadParents(out, group.first_parent + i - group.begin);
#if HWY_TARGET != HWY_SCALAR
  if (group.begin > 0) return collectParents(tree, out, i);
#endif
  return gatherParents(tree, out, i);
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
