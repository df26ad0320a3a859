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

HWY_INLINE void carry(const Parents& parent, const LanesQuat& local, Lanes h, int i,
                      BatchPoses& out) {
  const LanesQuat& q = parent.q;
  const Lanes two = all(2.f);
  store(parent.x + h * (two * (q.x * q.z + q.w * q.y)), out.x, i);
  store(parent.y + h * (two * (q.y * q.z - q.w * q.x)), out.y, i);
  store(parent.z + h * (all(1.f) - two * (q.x * q.x + q.y * q.y)), out.z, i);
  const LanesQuat world = multiply(q, local);
  store(world.w, out.qw, i);
  store(world.x, out.qx, i);
  store(world.y, out.qy, i);
  store(world.z, out.qz, i);
}

// Parents of continued limbs are consecutive and need no gather.
HWY_INLINE Parents parentsOf(const BatchTree& tree, const BatchGroup& group, const BatchPoses& out,
                             int i) {
  return group.first_parent >= 0 ? loadParents(out, group.first_parent + i - group.begin)
                                 : gatherParents(tree, out, i);
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // toggle
