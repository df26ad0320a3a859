// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display_context.h>
#include <rviz/viewport_mouse_event.h>

#include <string>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::view {

/// Ray under the mouse cursor [m].
struct Ray {
  Vec3 origin{Vec3::Zero()}, direction{Vec3::UnitX()};
};

/// Returns the ray in a tf frame. @throws std::runtime_error if there is no transform.
Ray rayOf(const rviz::ViewportMouseEvent& event, rviz::DisplayContext& context,
          const std::string& frame);

/// Returns the unit view direction of the event's camera in a tf frame. @throws as rayOf().
Vec3 sightOf(const rviz::ViewportMouseEvent& event, rviz::DisplayContext& context,
             const std::string& frame);

/// Intersects a ray with the plane through `point`. Returns false behind the origin of the ray.
bool meetPlane(const Ray& ray, const Vec3& point, const Vec3& normal, Vec3& place);

/// Passes a mouse event that a tool does not use to the view controller.
void passToView(rviz::ViewportMouseEvent& event);

}  // namespace vegetation_sim::view
