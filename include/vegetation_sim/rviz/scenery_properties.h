// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "vegetation_sim/rviz/material.h"

namespace rviz {
class BoolProperty;
class ColorProperty;
class Display;
class FloatProperty;
class StringProperty;
}  // namespace rviz

namespace vegetation_sim::view {

/// What the user of a display sets about ground, sky, haze and the published view. The properties
/// are children of the display, which owns them.
class SceneryProperties {
 public:
  bool ground() const;
  bool sky() const;
  bool haze() const;
  bool publishesViewer() const;  ///< false without addViewer()
  std::string viewerTopic() const;
  Haze hazeValues() const;
  Daylight daylight() const;
  /// Multiplies the ground's colours.
  Rgba groundTint() const;

 protected:
  /// @param display with the slots updateGround(), updateSky(), updateSun() and updateHaze().
  void addScenery(rviz::Display& display, const char* ground_help);
  /// @param display with the slot updateViewer().
  void addViewer(rviz::Display& display, const char* help);

 private:
  rviz::BoolProperty *ground_, *sky_, *haze_, *publish_viewer_{nullptr};
  rviz::ColorProperty* ground_colour_;
  rviz::FloatProperty *azimuth_, *elevation_, *haze_start_, *haze_end_, *haze_most_;
  rviz::StringProperty* viewer_topic_{nullptr};
};

}  // namespace vegetation_sim::view
