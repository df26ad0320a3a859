// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "ros/replicas/subscribed_meadow.h"
#include "rviz/ground/ground_visual.h"
#include "rviz/ground/meadow_texture.h"
#include "vegetation_sim/grass/lod/colour_mask.h"

namespace vegetation_sim::view {

/// The ground of a meadow with a texture of its grass and tracks. Render thread only.
class MeadowGround {
 public:
  /// @param meadow with a layout.
  MeadowGround(Ogre::SceneNode& parent, const SubscribedMeadow& meadow, const Daylight& daylight,
               const Rgba& tint);

  /// Paints tiles whose tracks have changed: those in `pressed` first, then some others.
  void update(const SubscribedMeadow& meadow, const std::set<std::pair<int, int>>& pressed,
              Nanoseconds stamp);
  void light(const Daylight& daylight, const Haze& haze);
  /// Darkens the ground under blades. @param distance [m] from the viewer.
  void darken(float distance) { ground_->darken(distance); }

  std::size_t paintedTracks() const { return tracks_.size(); }  ///< tiles with tracks

 private:
  void paint(const SubscribedMeadow& meadow, std::pair<int, int> tile, Nanoseconds stamp);
  void collect(const SubscribedMeadow& meadow);
  void followColours(const SubscribedMeadow& meadow, Nanoseconds stamp);
  void addTilesUnder(const std::vector<grass::ColourMask>& masks);

  std::shared_ptr<const grass::FeatureMap> map_;
  std::shared_ptr<const terrain::HeightMap> terrain_;
  Daylight daylight_;
  std::unique_ptr<MeadowPainter> painter_;
  std::unique_ptr<GroundVisual> ground_;
  std::set<std::pair<int, int>> tracks_;    // tiles with tracks in the texture
  std::set<std::pair<int, int>> pressed_;   // to be painted first
  std::pair<int, int> painted_{-1, -1};     // the last of these that was painted
  std::vector<grass::ColourMask> masks_;    // with which the texture was painted last
  std::vector<std::pair<int, int>> round_;  // to be painted in turn
  grass::CrushPatch patch_;
};

}  // namespace vegetation_sim::view
