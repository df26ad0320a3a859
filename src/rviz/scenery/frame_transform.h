// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <optional>
#include <string>

#include "rviz/scenery/status_board.h"
#include "rviz/trees/tree_set.h"

namespace rviz {
class DisplayContext;
}

namespace vegetation_sim::view {

/// Moves a display's node to `frame` in the fixed frame and reports it on the status board. Without
/// a transform it hides the node and returns false.
bool placeInFixedFrame(rviz::DisplayContext& context, const std::string& frame,
                       Ogre::SceneNode& node, StatusBoard& board);

/// Returns the camera in the frame of a display's node, or nothing without a camera.
std::optional<View> viewOf(rviz::DisplayContext& context, const Ogre::SceneNode& node);

}  // namespace vegetation_sim::view
