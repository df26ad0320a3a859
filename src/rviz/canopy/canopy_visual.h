// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <utility>
#include <vector>

#include "ros/replicas/subscribed_canopy.h"
#include "rviz/canopy/canopy_patch.h"
#include "rviz/canopy/layer_images.h"
#include "rviz/ground/ground_texture.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim::view {

/// Figures of the last update.
struct CanopyReport {
  std::size_t plants{0}, crowns{0}, leaves{0};  ///< in the layout
  std::size_t drawn{0};                         ///< leaves that are drawn one by one
  int layers{0}, pictures{0};                   ///< pictures: layers that are drawn as pictures
  int renderings{0};                            ///< number of times that pictures were rendered
  int rebuilds{0};                              ///< number of updates with changes
};

/// The OGRE objects of the plants and crowns of a layout, which it owns. Render thread only.
class CanopyVisual {
 public:
  struct Options {
    std::size_t most_leaves{40000};
    double share{1.0};     ///< of the leaves that would be drawn
    float tolerance{7.f};  ///< smaller leaves become fewer and larger [pixel]
    LayerImages::Options pictures;
  };

  /// @param parent node in the frame of the layout. @param canopy with a layout.
  /// Plants among trees have the light that other displays share.
  CanopyVisual(Ogre::SceneNode& parent, const SubscribedCanopy& canopy, const Vec3& to_sun);
  ~CanopyVisual();
  CanopyVisual(const CanopyVisual&) = delete;
  CanopyVisual& operator=(const CanopyVisual&) = delete;

  /// Draws the newest state if anything has changed. @param stamp of the wood of crowns.
  void update(SubscribedCanopy& canopy, Nanoseconds stamp, const View& view,
              const Options& options);
  void light(const Daylight& daylight, const Haze& haze);
  /// Moves all leaves again at the next update.
  void repaint();

  /// Square around the plants, and the light that reaches a window of its ground.
  Plot plot() const;
  Shade shadeOn(const Plot& plot, int edge, const Window& window, const terrain::HeightMap& ground,
                const Vec3& to_sun) const;
  /// Returns the areas of ground whose light cuts have changed since the last call.
  std::vector<Extent> takeCutAreas() { return std::exchange(cut_areas_, {}); }
  const CanopyReport& report() const { return report_; }
  /// Returns why textures of meshes are not shown.
  const std::vector<std::string>& textureFaults() const { return textures_.faults(); }

 private:
  void thinForms();
  PatchScene patchScene() const;
  void add(std::unique_ptr<CanopyPatch> patch);
  std::unique_ptr<CanopyPatch> patchOf(const canopy::Replica& canopy,
                                       const std::vector<std::size_t>& plants) const;
  void updatePatches(const canopy::Replica& canopy, bool relit);
  Extent shadowOf(const CanopyPatch& patch) const;
  const std::vector<bool>& updatePictures(const canopy::Foliage& foliage, const View& view,
                                          const LayerImages::Options& options);
  std::vector<CanopyPatch*> inPicture(const View& view, bool bent) const;

  std::string frame_;
  Vec3 to_sun_;
  canopy::Layout layout_, thinned_;
  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Vec3 origin_{Vec3::Zero()};
  PlantTextures textures_;
  Texture leaf_texture_, stem_texture_;
  Material leaf_material_, stem_material_;
  std::vector<std::unique_ptr<CanopyPatch>> patches_;
  std::unique_ptr<LayerImages> images_;  // null: no layer has a picture
  Daylight daylight_;
  Haze haze_;
  Extent extent_;
  std::vector<Extent> cut_areas_;
  int changes_{-1}, lights_{0};  // of the last update
  Nanoseconds stamp_{0};
  Vec3 eye_{Vec3::Zero()}, forward_{Vec3::Zero()};
  double share_{1.0};  // of the last update
  CanopyReport report_;
};

}  // namespace vegetation_sim::view
