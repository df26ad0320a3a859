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

/// Puts a display's node where `frame` is in the fixed frame, and says so on the board; hides it
/// where no transform is known. False then.
bool placeInFixedFrame(rviz::DisplayContext& context, const std::string& frame,
                       Ogre::SceneNode& node, StatusBoard& board);

/// Who looks at a display, in the frame of its node; none without a camera.
std::optional<View> viewOf(rviz::DisplayContext& context, const Ogre::SceneNode& node);

}  // namespace vegetation_sim::view
