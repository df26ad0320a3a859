// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/modal/modal_load.h"

// Vectors without arithmetic operators are left out; their processors take the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tree/modal/modal_load.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::forest::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void addRows(const double* push, std::size_t row, const Vec3* velocity, std::size_t count,
             double* out) {
  const hn::CappedTag<double, MODES_ABREAST> tag;
  for (std::size_t m = 0; m < row; m += hn::Lanes(tag)) {
    auto sum = hn::LoadU(tag, out + m);
    const double* from = push + m;
    for (std::size_t i = 0; i < count; ++i, from += 3 * row)
      sum = sum + (hn::LoadU(tag, from) * hn::Set(tag, velocity[i].x()) +
                   hn::LoadU(tag, from + row) * hn::Set(tag, velocity[i].y()) +
                   hn::LoadU(tag, from + 2 * row) * hn::Set(tag, velocity[i].z()));
    hn::StoreU(sum, tag, out + m);
  }
}

}  // namespace vegetation_sim::forest::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::forest {

HWY_EXPORT(addRows);

void addPushes(const double* push, std::size_t row, const Vec3* velocity, std::size_t count,
               double* out) {
  HWY_DYNAMIC_DISPATCH(addRows)(push, row, velocity, count, out);
}

}  // namespace vegetation_sim::forest
#endif
