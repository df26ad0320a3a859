// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim::view {

/// Counts triangles submitted to the renderer and flushes it at intervals, so that a software
/// rasteriser fills pixels on other cores while the next vertices are prepared. Render thread only,
/// while a picture is drawn.
void drew(std::size_t triangles);

}  // namespace vegetation_sim::view
