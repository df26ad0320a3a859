// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/grass/grass_properties.h"

#include <rviz/display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>

namespace vegetation_sim::view {
GrassProperties::GrassProperties(rviz::Display& display) {
  addTopics(display);
  addLook(display);
  addLevels(display);
  addScenery(display, "Draw the terrain with the colours of the meadow and the tracks in it.");
}

void GrassProperties::addTopics(rviz::Display& display) {
  layout_ = addTopic<GrassLayout>("Layout Topic", "grass/layout",
                                  "vegetation_sim/GrassLayout: the map of the meadow.", display);
  wind_ = addTopic<WindField>("Wind Topic", "wind", "vegetation_sim/WindField: the wind field.",
                              display);
  state_ = addTopic<GrassState>("State Topic", "grass/state",
                                "vegetation_sim/GrassState: trodden grass. If near beside it has a "
                                "publisher, the display reads the smaller NearGrass from there.",
                                display);
  colours_ =
      addTopic<GrassColours>("Colours Topic", "grass/colours",
                             "vegetation_sim/GrassColours: discs that colour the grass.", display);
}

void GrassProperties::addLook(rviz::Display& display) {
  most_blades_ = new rviz::IntProperty(
      "Blades", 25000,
      "Largest number of single blades in the picture. Farther blades become fewer, then "
      "strips stand among them, then strips alone.",
      &display, SLOT(updateLook()), &display);
  most_blades_->setMin(1000);
  most_blades_->setMax(2000000);
  addFrameTime(display, "blades");
  blades_ = addFlag("Single Blades", true, "Draw single blades near the viewer.", display);
  strips_ = addFlag("Strips", true, "Draw strips and layers farther away.", display);
  edge_strips_ = addFlag("Strips on Edges", false,
                         "Draw four strips on the edges of a tile, as paper 2 has them, instead of "
                         "rows in it: fewer triangles.",
                         display);
  variety_ =
      addNumber("Variety", 1.f, "How much colour, length and lean differ from blade to blade.", 0.f,
                2.f, display);
  colour_by_level_ = addFlag("Colour by Level", false,
                             "Paint blades red, strips blue and layers violet.", display);
  addRate(display, "Grass moves");
}

void GrassProperties::addLevels(rviz::Display& display) {
  tolerance_ = addNumber("Tolerance", 2.f, "Largest error of a level of detail [pixel].", 0.1f,
                         100.f, display);
  farthest_ = addNumber("Farthest", 160.f, "Beyond this distance grass is only a texture [m].", 1.f,
                        10000.f, display);
  transition_ =
      addNumber("Transition", 0.5f, "Time from one level to the next [s].", 0.f, 60.f, display);
}

SubscribedMeadow::Topics GrassProperties::topics() const {
  const std::string state = state_->getTopicStd();
  const std::string near = state.substr(0, state.rfind('/') + 1) + "near";
  return {layout_->getTopicStd(), wind_->getTopicStd(), state, colours_->getTopicStd(), near};
}

GrassVisual::Options GrassProperties::options() const {
  GrassVisual::Options out;
  out.levels.tolerance = static_cast<double>(tolerance_->getFloat());
  out.levels.transition = static_cast<double>(transition_->getFloat());
  out.levels.farthest = static_cast<double>(farthest_->getFloat());
  out.levels.most_blades = most_blades_->getInt();
  out.variety = variety_->getFloat();
  out.blades = blades_->getBool();
  out.strips = strips_->getBool();
  out.edge_strips = edge_strips_->getBool();
  out.colour_by_level = colour_by_level_->getBool();
  return out;
}

}  // namespace vegetation_sim::view
