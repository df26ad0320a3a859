// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/render/fog.h"

#include <OgreViewport.h>
#include <rviz/render_panel.h>

namespace vegetation_sim::view {

Fog::Fog(Ogre::SceneManager& scene, rviz::RenderPanel* panel, const Haze& haze, const Rgba& colour)
    : scene_(scene),
      panel_(panel),
      mode_(scene.getFogMode()),
      colour_(scene.getFogColour()),
      density_(scene.getFogDensity()),
      start_(scene.getFogStart()),
      end_(scene.getFogEnd()) {
  const Ogre::ColourValue value(colour[0], colour[1], colour[2], 1.f);
  // Linear fog is opaque at its end, so thin haze ends farther away.
  const float end = haze.start + (haze.end - haze.start) / std::max(haze.most, 0.05f);
  scene.setFog(haze.most > 0.f ? Ogre::FOG_LINEAR : Ogre::FOG_NONE, value, 0.f, haze.start, end);
  if (panel_ == nullptr || panel_->getViewport() == nullptr) return;
  background_ = panel_->getViewport()->getBackgroundColour();
  panel_->setBackgroundColor(value);
}

Fog::~Fog() {
  scene_.setFog(mode_, colour_, density_, start_, end_);
  if (panel_ != nullptr && panel_->getViewport() != nullptr)
    panel_->setBackgroundColor(background_);
}

}  // namespace vegetation_sim::view
