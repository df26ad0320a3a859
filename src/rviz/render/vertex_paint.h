// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vegetation_sim::view {

/// What of a vertex stays while it moves. As it lies in the buffer.
struct VertexPaint {
  float normal[3];         ///< at rest, unit
  std::uint8_t colour[4];  ///< red, green, blue; alpha: part of the sunlight that arrives
  float place[3];          ///< in the picture: u, v; part of the skylight that arrives
  float fade{0.f};         ///< 0: drawn; clock of fades when it comes, less than 0: when it goes
};
static_assert(sizeof(VertexPaint) == 32, "packed as the vertex declaration says");

}  // namespace vegetation_sim::view
