// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "wind/sampling/batch_wind.h"

// Vectors without arithmetic operators are left out; their processors use the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wind/sampling/batch_wind_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "wind/sampling/batch_wind-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

constexpr std::size_t ROW = 16;  // floats of a row; no vector is wider

void fillBlocks(const FloatWind& wind, const float* places, float* air, std::size_t blocks) {
  const std::size_t width = hn::Lanes(Tag());
  const Tag d;
  for (std::size_t block = 0; block < 3 * ROW * blocks; block += 3 * ROW)
    for (std::size_t x = block; x < block + ROW; x += width) {
      const std::size_t y = x + ROW, z = y + ROW;
      const Lanes3 v = windAt(
          wind, {hn::LoadU(d, places + x), hn::LoadU(d, places + y), hn::LoadU(d, places + z)});
      hn::StoreU(v.x, d, air + x);
      hn::StoreU(v.y, d, air + y);
      hn::StoreU(v.z, d, air + z);
    }
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::forest {

HWY_EXPORT(fillBlocks);

void fillWind(const FloatWind& wind, const float* places, float* air, std::size_t blocks) {
  HWY_DYNAMIC_DISPATCH(fillBlocks)(wind, places, air, blocks);
}

}  // namespace vegetation_sim::forest
#endif
