// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grass/mesh/grass_geometry.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::grass {

inline std::uint8_t byteOf(double part) {
  return static_cast<std::uint8_t>(255.0 * saturate(part) + 0.5);
}

/// Appends vertices and triangles to a mesh after reserving room for all of them.
class MeshWriter {
 public:
  MeshWriter(GrassMesh& mesh, std::size_t vertices, std::size_t triangles)
      : next_(static_cast<std::uint32_t>(mesh.vertexCount())) {
    position_ = grown(mesh.positions, 3 * vertices);
    texture_ = grown(mesh.texture, 2 * vertices);
    colour_ = grown(mesh.colours, 4 * vertices);
    index_ = grown(mesh.indices, 3 * triangles);
  }
  /// @return index of the vertex.
  std::uint32_t vertex(const Vec3& p, double u, double v, const Vec3& colour, double alpha) {
    for (int i = 0; i < 3; ++i) *position_++ = static_cast<float>(p[i]);
    *texture_++ = static_cast<float>(u);
    *texture_++ = static_cast<float>(v);
    for (int i = 0; i < 3; ++i) *colour_++ = byteOf(colour[i]);
    *colour_++ = byteOf(alpha);
    return next_++;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    *index_++ = a;
    *index_++ = b;
    *index_++ = c;
  }

 private:
  template <class T>
  static T* grown(MeshList<T>& list, std::size_t by) {
    list.resize(list.size() + by);
    return list.data() + (list.size() - by);
  }
  float *position_, *texture_;
  std::uint8_t* colour_;
  std::uint32_t *index_, next_;
};

}  // namespace vegetation_sim::grass
