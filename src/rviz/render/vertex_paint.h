// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace vegetation_sim::view {

/// Attributes of a vertex that do not change while it moves, in the layout of the vertex buffer.
struct VertexPaint {
  float normal[3];         ///< at rest, unit
  std::uint8_t colour[4];  ///< red, green, blue; alpha is the share of sunlight that arrives
  float place[3];          ///< texture coordinates u, v; share of skylight that arrives
  float fade{0.f};         ///< 0: opaque; else clock at which it fades in, or if negative, out
};
static_assert(sizeof(VertexPaint) == 32, "packed as the vertex declaration says");

}  // namespace vegetation_sim::view
