// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/canopy_properties.h"

#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>

namespace vegetation_sim::view {

CanopyProperties::CanopyProperties(rviz::Display& display) {
  layout_ = addTopic<CanopyLayout>("Layout Topic", "canopy/layout",
                                   "vegetation_sim/CanopyLayout: seeds of all plants.", display);
  state_ = addTopic<CanopyState>("State Topic", "canopy/state",
                                 "vegetation_sim/CanopyState: how the leaves move.", display);
  forest_layout_ = addTopic<ForestLayout>("Forest Layout Topic", "forest/layout",
                                          "Trees whose crowns the layout gives leaves.", display);
  forest_state_ = addTopic<ForestState>("Forest State Topic", "forest/view",
                                        "Which joints of these trees move.", display);
  wind_ = addTopic<WindField>("Wind Topic", "wind", "Wind of these trees.", display);
  most_leaves_ = new rviz::IntProperty(
      "Leaves", 40000,
      "Largest number of leaves in the picture. With fewer leaves, each becomes larger.", &display,
      SLOT(updateLook()), &display);
  most_leaves_->setMin(100);
  most_leaves_->setMax(2000000);
  addFrameTime(display, "leaves");
  tolerance_ =
      addNumber("Tolerance", 7.f, "Leaves shorter than this become fewer and larger [pixel].", 0.1f,
                1000.f, display);
  pictures_ = addNumber(
      "Picture Tolerance", 2.f,
      "Layers with many leaves are drawn as pictures that are warped, where the predicted error is "
      "below this [pixel]. 0: every leaf is drawn on its own.",
      0.f, 1000.f, display);
  addRate(display, "Leaves move");
  addScenery(display, "Draw grass with the plants' shadows, unless another display has a ground.");
}

SubscribedCanopy::Topics CanopyProperties::topics() const {
  return {layout_->getTopicStd(),
          state_->getTopicStd(),
          {forest_layout_->getTopicStd(), wind_->getTopicStd(), forest_state_->getTopicStd()}};
}

CanopyVisual::Options CanopyProperties::options() const {
  CanopyVisual::Options out;
  out.most_leaves = static_cast<std::size_t>(most_leaves_->getInt());
  out.tolerance = tolerance_->getFloat();
  out.pictures.tolerance = static_cast<double>(pictures_->getFloat());
  return out;
}

}  // namespace vegetation_sim::view
