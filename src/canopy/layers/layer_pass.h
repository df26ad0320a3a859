// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vegetation_sim::canopy {

constexpr std::size_t PASS = 256;  ///< cells that are looked up at once: a part of every field

/// Frames of a history by age, newest first.
struct FramesByAge {
  std::vector<const std::uint16_t*> u, v;  ///< half precision
  std::vector<float> depth;
};

/// PASS cells of a layer that moves as the first one did `distance / (|vz| + delay_speed)` ago, vz
/// its motion now towards the viewer.
struct LayerPass {
  const FramesByAge* frames;
  std::size_t begin;             ///< first cell
  std::array<float, 3> towards;  ///< the viewer's axis in the plane's components
  float distance, delay_speed;   ///< [m], [m/s]
  float rate;                    ///< frames a second
  std::array<float, PASS>*u, *v, *depth;
};

/// Single precision, the same bits on every processor: the frames have eleven.
void samplePast(const LayerPass& pass);

}  // namespace vegetation_sim::canopy
