// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "canopy/layers/layer_pass.h"

#include <algorithm>

// Vectors without arithmetic operators are not used; their processors run the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "canopy/layers/layer_pass.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::canopy::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes all(float value) {
  return hn::Set(Tag(), value);
}

HWY_INLINE Lanes load(const std::uint16_t* halfs) {
  const hn::Rebind<std::uint16_t, Tag> bits;
  const hn::Rebind<hwy::float16_t, Tag> numbers;
  return hn::PromoteTo(Tag(), hn::BitCast(numbers, hn::LoadU(bits, halfs)));
}

HWY_INLINE Lanes agesOf(const LayerPass& pass, std::size_t cell) {
  const FramesByAge& frames = *pass.frames;
  const Lanes across = load(frames.u[0] + cell) * all(pass.towards[0]) +
                       load(frames.v[0] + cell) * all(pass.towards[1]);
  const Lanes vz = across + all(frames.depth[0] * pass.towards[2]);
  const Lanes delay = all(pass.distance) / (hn::Abs(vz) + all(pass.delay_speed));
  const auto oldest = static_cast<float>(frames.u.size() - 1);
  return hn::Min(delay * all(pass.rate), all(oldest));
}

// Neighbours have nearly the same delay, so few frames serve all lanes.
void cells(const LayerPass& pass) {
  const FramesByAge& frames = *pass.frames;
  const std::size_t last = frames.u.size() - 1;
  for (std::size_t i = 0; i < PASS; i += hn::Lanes(Tag())) {
    const std::size_t cell = pass.begin + i;
    const Lanes age = agesOf(pass, cell), whole = hn::Floor(age), q = age - whole;
    const Lanes p = all(1.f) - q;
    const auto first = static_cast<std::size_t>(hn::GetLane(hn::MinOfLanes(Tag(), whole)));
    const auto end = static_cast<std::size_t>(hn::GetLane(hn::MaxOfLanes(Tag(), whole)));
    Lanes u = all(0.f), v = u, depth = u;
    for (std::size_t late = first; late <= end; ++late) {
      const std::size_t early = std::min(last, late + 1);
      const auto here = whole == all(static_cast<float>(late));
      u = hn::IfThenElse(here, p * load(frames.u[late] + cell) + q * load(frames.u[early] + cell),
                         u);
      v = hn::IfThenElse(here, p * load(frames.v[late] + cell) + q * load(frames.v[early] + cell),
                         v);
      depth =
          hn::IfThenElse(here, p * all(frames.depth[late]) + q * all(frames.depth[early]), depth);
    }
    hn::StoreU(u, Tag(), pass.u->data() + i);
    hn::StoreU(v, Tag(), pass.v->data() + i);
    hn::StoreU(depth, Tag(), pass.depth->data() + i);
  }
}

}  // namespace vegetation_sim::canopy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::canopy {

HWY_EXPORT(cells);

void samplePast(const LayerPass& pass) {
  HWY_DYNAMIC_DISPATCH(cells)(pass);
}

}  // namespace vegetation_sim::canopy
#endif
