// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace vegetation_sim::view {

/// Tells that so many triangles were given to the renderer, which starts on them now and then: a
/// software rasteriser fills pixels on the other cores while the next vertices are on their way.
/// Render thread only, while a picture is drawn.
void drew(std::size_t triangles);

}  // namespace vegetation_sim::view
