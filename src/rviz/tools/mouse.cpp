// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/mouse.h"

#include <OgreCamera.h>
#include <OgreRay.h>
#include <OgreViewport.h>
#include <rviz/frame_manager.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>

#include <cmath>
#include <stdexcept>

#include "rviz/render/ogre_vectors.h"

namespace vegetation_sim::view {
namespace {

struct Placement {
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
};

// Returns the pose of the frame in the fixed frame.
Placement placementOf(rviz::DisplayContext& context, const std::string& frame) {
  Placement out;
  if (!context.getFrameManager()->getTransform(frame, ros::Time(), out.position, out.orientation))
    throw std::runtime_error("tf knows no way from '" + frame + "' to the fixed frame");
  return out;
}

}  // namespace

Ray rayOf(const rviz::ViewportMouseEvent& event, rviz::DisplayContext& context,
          const std::string& frame) {
  const Placement place = placementOf(context, frame);
  const Ogre::Ray ray = event.viewport->getCamera()->getCameraToViewportRay(
      static_cast<float>(event.x) / static_cast<float>(event.viewport->getActualWidth()),
      static_cast<float>(event.y) / static_cast<float>(event.viewport->getActualHeight()));
  const Ogre::Quaternion back = place.orientation.Inverse();
  return {toVec3(back * (ray.getOrigin() - place.position)), toVec3(back * ray.getDirection())};
}

Vec3 sightOf(const rviz::ViewportMouseEvent& event, rviz::DisplayContext& context,
             const std::string& frame) {
  const Placement place = placementOf(context, frame);
  return toVec3(place.orientation.Inverse() * event.viewport->getCamera()->getDerivedDirection());
}

bool meetPlane(const Ray& ray, const Vec3& point, const Vec3& normal, Vec3& place) {
  const double closing = ray.direction.dot(normal);
  if (std::fabs(closing) < 1e-6 * ray.direction.norm() * normal.norm()) return false;
  const double distance = (point - ray.origin).dot(normal) / closing;
  if (!(distance > 0.0)) return false;
  place = ray.origin + distance * ray.direction;
  return true;
}

void passToView(rviz::ViewportMouseEvent& event) {
  if (event.panel->getViewController() != nullptr)
    event.panel->getViewController()->handleMouseEvent(event);
}

}  // namespace vegetation_sim::view
