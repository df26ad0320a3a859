// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/render/drawing.h"

#include <GL/gl.h>

namespace vegetation_sim::view {

void drew(std::size_t triangles) {
  constexpr std::size_t ENOUGH = 20000;  // a flush costs a rasteriser about 0.2 ms
  static std::size_t waiting = 0;
  waiting += triangles;
  if (waiting < ENOUGH) return;
  waiting = 0;
  glFlush();
}

}  // namespace vegetation_sim::view
