// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <vector>

#include "grass/lod/meadow_lod.h"
#include "ros/replicas/subscribed_meadow.h"
#include "rviz/grass/blade_widths.h"
#include "rviz/render/grass_batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim::view {

/// Figures of the last update.
struct GrassReport {
  std::size_t tiles{0};     ///< of the map
  std::size_t blades{0};    ///< single ones
  std::size_t bladed{0};    ///< tiles of blades
  std::size_t stripped{0};  ///< tiles of strips or layers
  std::size_t trodden{0};   ///< blocks of trodden ground
  std::size_t triangles{0};
  int rebuilds{0};  ///< number of meshes built
};

/// The OGRE objects of the grass of a layout, which it owns: blades near the viewer, strips and
/// layers farther away (paper 2, section 3). Render thread only.
class GrassVisual {
 public:
  struct Options {
    grass::MeadowSettings levels;
    float variety{1.f};  ///< see RibbonStyle::variety
    bool blades{true}, strips{true};
    /// The four strips on the edges of a tile (paper 2, section 3.4) instead of rows in it.
    bool edge_strips{false};
    bool colour_by_level{false};  ///< blades red, strips blue
  };

  /// @param parent node in the frame of the layout. @param meadow with a layout.
  GrassVisual(Ogre::SceneNode& parent, const SubscribedMeadow& meadow);
  ~GrassVisual();
  GrassVisual(const GrassVisual&) = delete;
  GrassVisual& operator=(const GrassVisual&) = delete;

  /// Draws the grass at `stamp` if anything has changed. Levels follow the clock `wall` [s], also
  /// while simulation time is paused.
  void update(const SubscribedMeadow& meadow, Nanoseconds stamp, double wall, const View& view,
              const Options& options);
  void light(const Daylight& daylight, const Haze& haze);
  /// Builds all meshes again at the next update.
  void repaint() { drawn_ = Drawn(); }

  const GrassReport& report() const { return report_; }
  /// Distance [m] to which most grass is single blades; 0: none.
  float bladesReach() const { return reach_; }

 private:
  /// Inputs of the meshes.
  struct Drawn {
    Nanoseconds stamp{-1};
    int changes{-1};
    Vec3 eye{Vec3::Zero()}, forward{Vec3::Zero()};
    std::size_t blades{0};
    bool settled{false};
  };
  bool isDrawn(const Drawn& wanted) const;
  Nanoseconds levelClock(double wall, double transition);
  void build(const SubscribedMeadow& meadow, Nanoseconds stamp, const View& view,
             const std::vector<grass::TileView>& tiles, const Options& options);
  void addBlades(const grass::Tile& tile, const grass::TileMotion& motion,
                 const grass::TileView& view, const BladeWidths& widths, const Vec3& eye,
                 const Options& options);
  void addFlat(const grass::Tile& tile, const grass::TileMotion& motion,
               const grass::TileView& view, double missing, const Options& options);
  void tint(const Options& options);

  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Vec3 origin_;
  grass::MeadowLod levels_;
  double full_density_;
  grass::GrassLight light_;
  Texture strip_texture_, layer_texture_;
  Material blade_material_, strip_material_, layer_material_;
  GrassBatch blades_, strips_, layers_;
  grass::GrassMesh blade_mesh_, strip_mesh_, layer_mesh_;
  std::vector<grass::BladeBlock> blocks_;
  grass::CrushPatch patch_;
  Drawn drawn_;
  double clock_{0.0}, wall_{0.0};  // [s] of levels; of the last update
  float reach_{0.f};
  GrassReport report_;
};

}  // namespace vegetation_sim::view
