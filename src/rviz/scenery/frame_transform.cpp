// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/frame_transform.h"

#include <OgreCamera.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/render_panel.h>
#include <rviz/validate_floats.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>

#include <algorithm>
#include <cmath>

namespace vegetation_sim::view {
namespace {

Vec3 widen(const Ogre::Vector3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace

bool placeInFixedFrame(rviz::DisplayContext& context, const std::string& frame,
                       Ogre::SceneNode& node, StatusBoard& board) {
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  if (!context.getFrameManager()->getTransform(frame, ros::Time(), position, orientation)) {
    board.show(rviz::StatusProperty::Error, "Transform",
               "No transform from " + frame + " to " + context.getFixedFrame().toStdString());
    node.setVisible(false);
    return false;
  }
  if (!rviz::validateFloats(position) || orientation.isNaN()) return false;
  board.show(rviz::StatusProperty::Ok, "Transform", "OK");
  node.setVisible(true);
  node.setPosition(position);
  node.setOrientation(orientation);
  return true;
}

std::optional<View> viewOf(rviz::DisplayContext& context, const Ogre::SceneNode& node) {
  rviz::ViewController* controller = context.getViewManager()->getCurrent();
  if (controller == nullptr || controller->getCamera() == nullptr) return {};
  controller->update(0.f, 0.f);  // rviz moves its camera after it updates the displays
  const Ogre::Camera& camera = *controller->getCamera();
  const Ogre::Vector3 position = camera.getDerivedPosition();
  if (!rviz::validateFloats(position)) return {};
  View view;
  const Ogre::Quaternion back = node.getOrientation().Inverse();
  view.eye.position = widen(back * (position - node.getPosition()));
  view.forward = widen(back * camera.getDerivedDirection());
  const double half = 0.5 * static_cast<double>(camera.getFOVy().valueRadians());
  const auto aspect = static_cast<double>(camera.getAspectRatio());
  view.half_angle = std::atan(std::tan(half) * std::hypot(1.0, aspect));
  view.half_height = std::tan(half);
  view.half_width = view.half_height * aspect;
  const rviz::RenderPanel* panel = context.getViewManager()->getRenderPanel();
  const double height = panel != nullptr ? std::max(panel->height(), 1) : 900.0;
  view.eye.pixels_per_radian = 0.5 * height / std::tan(half);
  return view;
}

}  // namespace vegetation_sim::view
