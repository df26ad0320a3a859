// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/common/math.h"
#include "vegetation_sim/grass/geometry.h"

namespace vegetation_sim::grass {

inline std::uint8_t byteOf(double part) {
  return static_cast<std::uint8_t>(255.0 * saturate(part) + 0.5);
}

/// @return its index.
inline std::uint32_t addVertex(GrassMesh& mesh, const Vec3& p, double u, double v,
                               const Vec3& colour, double alpha) {
  const auto index = static_cast<std::uint32_t>(mesh.vertexCount());
  for (int i = 0; i < 3; ++i) mesh.positions.push_back(static_cast<float>(p[i]));
  mesh.texture.push_back(static_cast<float>(u));
  mesh.texture.push_back(static_cast<float>(v));
  for (int i = 0; i < 3; ++i) mesh.colours.push_back(byteOf(colour[i]));
  mesh.colours.push_back(byteOf(alpha));
  return index;
}

inline void addTriangle(GrassMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

}  // namespace vegetation_sim::grass
