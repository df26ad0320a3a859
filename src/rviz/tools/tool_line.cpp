// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/tools/tool_line.h"

#include <OgreQuaternion.h>
#include <OgreSceneManager.h>
#include <OgreVector3.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/ogre_helpers/billboard_line.h>

#include "rviz/render/ogre_vectors.h"

namespace vegetation_sim::view {

ToolLine::ToolLine(float width) : width_(width) {}
ToolLine::~ToolLine() = default;

void ToolLine::draw(rviz::DisplayContext& context, const std::string& frame, const Vec3& from,
                    const Vec3& to, const Ogre::ColourValue& colour) {
  if (!line_) {
    line_ = std::make_unique<rviz::BillboardLine>(context.getSceneManager());
    line_->setLineWidth(width_);
  }
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  if (!context.getFrameManager()->getTransform(frame, ros::Time(), position, orientation)) return;
  line_->setPosition(position);
  line_->setOrientation(orientation);
  line_->clear();
  for (const Vec3& end : {from, to}) line_->addPoint(toOgre(end), colour);
}

void ToolLine::clear() {
  line_.reset();
}

}  // namespace vegetation_sim::view
