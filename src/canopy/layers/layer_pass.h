// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegetation_sim::canopy {

constexpr std::size_t PASS = 256;  ///< cells of one pass; divides every field

/// Frames of a history by age, newest first.
struct FramesByAge {
  std::vector<const std::uint16_t*> u, v;  ///< frames in half precision
  std::vector<float> depth;
};

/// PASS cells of a layer that moves as the first one did `distance / (|vz| + delay_speed)` ago,
/// where vz is its present velocity towards the viewer.
struct LayerPass {
  const FramesByAge* frames;
  std::size_t begin;             ///< first cell
  std::array<float, 3> towards;  ///< axis towards the viewer in the plane's components
  float distance, delay_speed;   ///< [m], [m/s]
  float rate;                    ///< frames per second
  std::array<float, PASS>*u, *v, *depth;
};

/// Computes in single precision with the same bits on every processor; the frames have only 11
/// bits.
void samplePast(const LayerPass& pass);

}  // namespace vegetation_sim::canopy
