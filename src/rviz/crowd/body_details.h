// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/crowd/body_template.h"

namespace vegetation_sim::view {

/// Direction of a vertex from the middle of its ring: to the left and to the front.
struct Around {
  double left, front;
};
/// Returns the direction of a vertex of a ring. Those of trunk and
/// head are denser in front.
Around aroundOf(FormTube::Kind kind, std::size_t vertex);
/// Returns the column of a vertex: 0 in front, 6 behind.
std::size_t columnOf(std::size_t vertex);

/// Returns the cover of a vertex of a ring. @param hairline of its column, above the neck.
Cover coverOf(FormTube::Kind kind, const FormRing& ring, std::size_t vertex, double hairline);

/// Moves vertices of the face and of hands, and paints brows, lips and the shade of the eyes.
void shapeDetails(FormTube::Kind kind, const FormRing& ring, std::size_t vertex,
                  const Vec3& outward, SkinVertex& out);
/// Adds folds of clothes and strands of hair. @param number of the vertex in its tube.
void crease(std::uint64_t number, SkinVertex& vertex);
/// Sets the moves of other builds.
void setBuilds(const FormTube& tube, const FormRing& ring, SkinVertex& vertex);
/// Sets the bones that a vertex follows.
void bindTo(const FormTube& tube, SkinVertex& vertex);

}  // namespace vegetation_sim::view
