// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/air_blocks.h"

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "forest/air_blocks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "forest/batch_wind-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

constexpr std::size_t ROW = 16;  // floats of a row; no vector is wider

void fillBlocks(const FloatWind& wind, float* rows, std::size_t blocks) {
  const std::size_t width = hn::Lanes(Tag());
  for (float* block = rows; block != rows + 6 * ROW * blocks; block += 6 * ROW)
    for (std::size_t i = 0; i < ROW; i += width) {
      const auto row = [&](std::size_t k) { return block + k * ROW + i; };
      const Lanes3 v = windAt(
          wind, {hn::LoadU(Tag(), row(0)), hn::LoadU(Tag(), row(1)), hn::LoadU(Tag(), row(2))});
      hn::StoreU(v.x, Tag(), row(3));
      hn::StoreU(v.y, Tag(), row(4));
      hn::StoreU(v.z, Tag(), row(5));
    }
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::forest {

HWY_EXPORT(fillBlocks);

void fillAir(const FloatWind& wind, float* rows, std::size_t blocks) {
  HWY_DYNAMIC_DISPATCH(fillBlocks)(wind, rows, blocks);
}

}  // namespace vegetation_sim::forest
#endif
