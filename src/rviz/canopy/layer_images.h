// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreCamera.h>
#include <OgreSceneManager.h>

#include <memory>
#include <string>
#include <vector>

#include "rviz/canopy/layer_picture.h"
#include "rviz/canopy/leaves_at_rest.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim::view {

/// Layers of plants that are drawn as pictures instead of leaf by leaf (paper 3). The pictures are
/// on the graphics card alone (S3-W7); the processor moves the grids on which they lie. They are
/// rendered when the layers are cut, when the eye has moved so far that the predicted error exceeds
/// the tolerance, and when leaves or light have changed. Rendering many leaves takes several
/// updates, and new pictures fade in over the old ones. A layer with few leaves, or whose picture
/// would have too large an error, has none. Render thread only.
class LayerImages {
 public:
  struct Options {
    double tolerance{2.0};            ///< largest predicted error [pixel]; 0: no pictures
    std::size_t fewest_leaves{4000};  ///< of a layer that gets a picture
  };

  /// @param node of the plants, with its frame at `origin` [m]. @param layout lives longer.
  /// @param leaf_texture name.
  LayerImages(Ogre::SceneNode& node, const canopy::Layout& layout, const Vec3& origin,
              const std::string& leaf_texture, const PlantTextures& textures, const Vec3& to_sun);
  ~LayerImages();
  LayerImages(const LayerImages&) = delete;
  LayerImages& operator=(const LayerImages&) = delete;

  /// Returns whether the renderer can draw into textures with the shaders of leaves.
  static bool isSupported();

  /// Moves the pictures, and renders new ones where they are needed. @param patches those of plants
  /// whose leaves stand upright. @param now of any clock that runs evenly [s].
  void update(const canopy::Foliage& foliage, const std::vector<const CanopyPatch*>& patches,
              const View& view, double now, const Options& options);
  void light(const Daylight& daylight, const Haze& haze);
  /// Renders all pictures again at the next update.
  void renderAgain() { outdated_ = true; }
  /// Forgets all patches, since one of them will be destroyed.
  void dropPatches() { leaves_->drop(); }

  /// Returns for each layer whether a picture shows it.
  const std::vector<bool>& pictured() const { return pictured_; }
  /// Returns whether pictures are to be rendered, or fade in.
  bool isBusy() const { return stale_ || begun_ || !before_.empty(); }
  /// Number of times that pictures have been rendered.
  int renderings() const { return renderings_; }

 private:
  using Pictures = std::vector<std::unique_ptr<LayerPicture>>;
  /// Parts of the leaves that are added to a picture in one update.
  struct Job {
    LayerPicture* picture;
    std::vector<Batch*> parts;
  };

  bool isStale(const canopy::Foliage& foliage, const View& view, const Options& options) const;
  void begin(const canopy::Foliage& foliage, const View& view, const Options& options);
  Pictures makePictures(const canopy::Foliage& foliage, const View& view, const Options& options);
  void setCamera(const canopy::ImageFrame& frame);
  void addJobs(const canopy::LayerCut& cut, LayerPicture& picture, double pixels_per_radian);
  void work();
  void finish(double now);
  void fade(double now);

  Ogre::SceneNode* node_;
  Vec3 origin_;
  Ogre::SceneManager* scene_;  // owned by Ogre, destroyed in the destructor
  Ogre::Camera* camera_;
  Ogre::SceneNode* camera_node_;
  Material material_;  // of leaves at rest
  std::unique_ptr<LeavesAtRest> leaves_;
  Pictures pictures_, before_, coming_;
  std::vector<Job> jobs_;  // the next one last
  std::vector<bool> pictured_;
  canopy::ImageFrame frame_;
  canopy::LayerCut cut_;
  Nanoseconds cut_since_{-1};
  int layers_{0}, renderings_{0};
  double begun_at_{-1e9}, fade_from_{0.0};
  bool outdated_{true}, stale_{true}, begun_{false};
};

}  // namespace vegetation_sim::view
