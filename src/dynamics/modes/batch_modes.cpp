// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/dynamics/modes/batch_modes.h"

// Vectors without arithmetic operators are left out; their processors use the plain target.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "dynamics/modes/batch_modes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegetation_sim::physics::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, BatchModes::BLOCK / 2>;

// Sums both bends of one block of joints, two vectors at once, because a single one would wait for
// its sums.
HWY_INLINE void sumBlock(const float* shapes, const float* amplitude, std::size_t modes,
                         float* first, float* second) {
  const Tag tag;
  constexpr std::size_t BLOCK = BatchModes::BLOCK;
  const std::size_t width = hn::Lanes(tag);
  for (std::size_t lane = 0; lane < BLOCK; lane += 2 * width) {
    auto a = hn::Zero(tag), b = a, c = a, d = a;
    const float* shape = shapes + lane;
    for (std::size_t m = 0; m < modes; ++m, shape += 2 * BLOCK) {
      const auto factor = hn::Set(tag, amplitude[m]);
      a = a + factor * hn::LoadU(tag, shape);
      b = b + factor * hn::LoadU(tag, shape + width);
      c = c + factor * hn::LoadU(tag, shape + BLOCK);
      d = d + factor * hn::LoadU(tag, shape + BLOCK + width);
    }
    hn::StoreU(a, tag, first + lane);
    hn::StoreU(b, tag, first + lane + width);
    hn::StoreU(c, tag, second + lane);
    hn::StoreU(d, tag, second + lane + width);
  }
}

void sumModes(const float* shapes, const float* amplitude, std::size_t modes, std::size_t joints,
              float* first, float* second) {
  for (std::size_t i = 0; i < joints; i += BatchModes::BLOCK)
    sumBlock(shapes + 2 * modes * i, amplitude, modes, first + i, second + i);
}

}  // namespace vegetation_sim::physics::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegetation_sim::physics {

HWY_EXPORT(sumModes);

BatchModes::BatchModes(const Modes& modes)
    : joints_(modes.length / 2),
      modes_(modes.size()),
      lines_(2 * BLOCK / LINE * modes_ * ((joints_ + BLOCK - 1) / BLOCK)) {
  auto* shapes = reinterpret_cast<float*>(lines_.data());
  for (std::size_t i = 0; i < joints_; ++i)
    for (std::size_t m = 0; m < modes_; ++m) {
      float* row = shapes + 2 * BLOCK * (modes_ * (i / BLOCK) + m) + i % BLOCK;
      row[0] = static_cast<float>(modes.shapeOf(m)[2 * i]);
      row[BLOCK] = static_cast<float>(modes.shapeOf(m)[2 * i + 1]);
    }
}

void BatchModes::bends(const std::vector<double>& amplitude, BatchBends& out) const {
  if (out.first.size() < joints_ + PADDING) {
    out.first.resize(joints_ + PADDING);
    out.second.resize(joints_ + PADDING);
  }
  out.amplitude.resize(modes_);
  for (std::size_t m = 0; m < modes_; ++m) out.amplitude[m] = static_cast<float>(amplitude[m]);
  HWY_DYNAMIC_DISPATCH(sumModes)
  (reinterpret_cast<const float*>(lines_.data()), out.amplitude.data(), modes_, joints_,
   out.first.data(), out.second.data());
}

}  // namespace vegetation_sim::physics
#endif
