// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display_context.h>
#include <rviz/viewport_mouse_event.h>

#include <string>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::view {

/// Where the mouse points [m].
struct Ray {
  Vec3 origin{Vec3::Zero()}, direction{Vec3::UnitX()};
};

/// Ray through the mouse in a tf frame. @throws std::runtime_error if tf does not know the frame.
Ray rayOf(const rviz::ViewportMouseEvent& event, rviz::DisplayContext& context,
          const std::string& frame);

/// Unit vector along which the event's camera looks, in a tf frame. @throws as rayOf.
Vec3 sightOf(const rviz::ViewportMouseEvent& event, rviz::DisplayContext& context,
             const std::string& frame);

/// Where a ray meets the plane through `point`; false if it does not in front of its origin.
bool meetPlane(const Ray& ray, const Vec3& point, const Vec3& normal, Vec3& place);

/// Lets the view have a mouse event that a tool has no use for.
void passToView(rviz::ViewportMouseEvent& event);

}  // namespace vegetation_sim::view
