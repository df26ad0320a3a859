// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreColourValue.h>

#include <memory>
#include <string>

#include "vegetation_sim/core/math/vectors.h"

namespace rviz {
class BillboardLine;
class DisplayContext;
}  // namespace rviz

namespace vegetation_sim::view {

/// The line that a tool draws while a button is held.
class ToolLine {
 public:
  explicit ToolLine(float width);  ///< [m]
  ~ToolLine();

  /// Sets both ends in a frame. Without a transform the line stays as it is.
  void draw(rviz::DisplayContext& context, const std::string& frame, const Vec3& from,
            const Vec3& to, const Ogre::ColourValue& colour);
  void clear();

 private:
  float width_;
  std::unique_ptr<rviz::BillboardLine> line_;
};

}  // namespace vegetation_sim::view
