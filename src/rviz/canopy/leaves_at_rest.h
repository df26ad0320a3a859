// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneManager.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "canopy/plants/placing.h"
#include "rviz/canopy/canopy_patch.h"

namespace vegetation_sim::view {

/// The leaves of plants at rest, in a scene of their own, from which pictures are rendered. Plants
/// that are read from a file share their triangles with all plants of their kind. Render thread
/// only.
class LeavesAtRest {
 public:
  /// @param scene with its frame at `origin` [m]. @param material of layered leaves.
  /// @param textures outlive the object.
  LeavesAtRest(Ogre::SceneManager& scene, const canopy::Layout& layout, const Vec3& origin,
               const std::string& material, const PlantTextures& textures, const Vec3& to_sun);
  ~LeavesAtRest();

  /// Sets the patches whose leaves there are. Returns whether they are others than before.
  bool choose(const std::vector<const CanopyPatch*>& patches);
  /// Forgets all patches, since one of them will be destroyed.
  void drop();

  /// Number of leaves.
  std::size_t leafCount() const;
  /// Calls visit(leaf, plant) for every `stride`-th leaf of each plant or patch.
  template <class Visit>
  void eachLeaf(std::size_t stride, const Visit& visit) const;

  /// A part that is rendered at once.
  struct Part {
    Batch* batch;
    Vec3 middle;
    double reach;  ///< [m]
    double area;   ///< of a plant that shares its triangles, from the side [m2]; else 0
  };
  std::vector<Part> parts() const;

 private:
  struct Form {  // of a kind that is read from a file
    std::unique_ptr<canopy::Layout> layout;
    std::unique_ptr<CanopyPatch> plant;  // at the origin, with scale 1
    std::unique_ptr<Batch> batch;
  };
  struct Instance {
    std::size_t plant;
    std::unique_ptr<Batch> batch;
    Ogre::SceneNode* node;
  };
  struct Rest {
    const CanopyPatch* patch;
    std::unique_ptr<Batch> batch;  // of the leaves that are not alike
    std::vector<Instance> instances;
  };
  Rest restOf(const CanopyPatch& patch);
  const Form& formOf(std::size_t kind);
  Instance instanceOf(std::size_t plant);
  void remove(Rest& rest);

  Ogre::SceneManager* scene_;
  Ogre::SceneNode* hidden_;  // not in the scene: prototypes
  const canopy::Layout& layout_;
  Vec3 origin_;
  std::string material_;
  const PlantTextures& textures_;
  Vec3 to_sun_;
  std::map<std::size_t, Form> forms_;
  std::vector<Rest> rest_;
};

template <class Visit>
void LeavesAtRest::eachLeaf(std::size_t stride, const Visit& visit) const {
  for (const Rest& rest : rest_) {
    rest.patch->eachLeaf(CanopyPatch::Share::OTHERS, stride, visit);
    for (const Instance& instance : rest.instances) {
      const canopy::Plant& plant = layout_.plants[instance.plant];
      const canopy::Placing placing(plant, plant.scale);
      forms_.at(plant.kind)
          .plant->eachLeaf(CanopyPatch::Share::ALIKE, stride,
                           [&](const canopy::Leaf& leaf, std::size_t) {
                             visit(placing.placed(leaf), instance.plant);
                           });
    }
  }
}

}  // namespace vegetation_sim::view
