// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/forest/forest_properties.h"

#include <rviz/display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <vegetation_sim/GrabStatuses.h>

namespace vegetation_sim::view {
ForestProperties::ForestProperties(rviz::Display& display) {
  addTopics(display);
  addLook(display);
  addScenery(display, "Draw the terrain with grass and forest floor.");
}

void ForestProperties::addTopics(rviz::Display& display) {
  layout_ = addTopic<ForestLayout>("Layout Topic", "forest/layout",
                                   "vegetation_sim/ForestLayout: seeds of all trees.", display);
  wind_ = addTopic<WindField>("Wind Topic", "wind", "vegetation_sim/WindField: the wind field.",
                              display);
  state_ = addTopic<ForestState>("State Topic", "forest/view",
                                 "vegetation_sim/ForestState: which joints move.", display);
  grabs_ = addTopic<GrabStatuses>("Grabs Topic", "forest/grabs",
                                  "vegetation_sim/GrabStatuses: which branches are held.", display);
}

void ForestProperties::addLook(rviz::Display& display) {
  triangles_ = new rviz::IntProperty(
      "Triangles", 80000,
      "Target number of triangles of trees in the picture. Levels of detail follow.", &display);
  triangles_->setMin(1000);
  triangles_->setMax(20000000);
  addFrameTime(display, "triangles");
  most_trees_ =
      new rviz::IntProperty("Most Trees", 1000, "Number of trees that are drawn, nearest first.",
                            &display, SLOT(updateTrees()), &display);
  most_trees_->setMin(1);
  most_trees_->setMax(20000);
  by_bough_ = addFlag("Detail by Boughs", true,
                      "Boughs of near trees have levels of detail by their own distance.", display);
  leaves_ = new rviz::BoolProperty("Leaves", true, "Draw leaves.", &display, SLOT(updateTrees()),
                                   &display);
  flutter_ = addFlag("Flutter", true, "Leaves flutter where wind blows.", display);
  moving_shadows_ = new rviz::BoolProperty(
      "Moving Shadows", false, "Shadows on the ground follow the trees near the viewer.", &display,
      SLOT(updateGround()), &display);
  contact_shadows_ =
      new rviz::BoolProperty("Contact Shadows", true, "Darken the ground around trunks.", &display,
                             SLOT(updateGround()), &display);
  colours_ = new rviz::EnumProperty("Colours", "natural",
                                    "By state: branches are painted by their joint: red moves, "
                                    "green is between moving and fixed, "
                                    "yellow is held, blue is physical, bark is fixed.",
                                    &display, SLOT(updateLook()), &display);
  colours_->addOption("natural", static_cast<int>(TreeColours::NATURAL));
  colours_->addOption("by state", static_cast<int>(TreeColours::BY_STATE));
  addRate(display, "Trees move");
}

SubscribedForest::Topics ForestProperties::topics() const {
  return {layout_->getTopicStd(), wind_->getTopicStd(), state_->getTopicStd()};
}

bool ForestProperties::hasContactShadows() const {
  return contact_shadows_->getBool();
}

bool ForestProperties::movesShadows() const {
  return moving_shadows_->getBool();
}

std::string ForestProperties::grabsTopic() const {
  return grabs_->getTopicStd();
}

ForestVisual::Options ForestProperties::options() const {
  ForestVisual::Options out;
  out.look = {leaves_->getBool(), flutter_->getBool(),
              static_cast<TreeColours>(colours_->getOptionInt())};
  out.target_triangles = triangles_->getInt();
  out.by_bough = by_bough_->getBool();
  out.most_trees = static_cast<std::size_t>(most_trees_->getInt());
  return out;
}

}  // namespace vegetation_sim::view
