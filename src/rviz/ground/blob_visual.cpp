// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/blob_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <utility>

#include "rviz/render/batch.h"
#include "rviz/render/ogre_vectors.h"
#include "rviz/textures/shadow_texture.h"

namespace vegetation_sim::view {
namespace {

std::vector<const BlobVisual*>& allBlobs() {
  static std::vector<const BlobVisual*> blobs;
  return blobs;
}

}  // namespace

BlobVisual::BlobVisual(Ogre::SceneNode& parent)
    : node_(parent.createChildSceneNode()),
      texture_(uniqueName("blob_picture"), mipmaps(blobPicture())),
      material_(Material::Kind::SHADOWS, uniqueName("blob_material"), {texture_.name()}),
      batch_(uniqueName("blobs"), material_.name(), Batch::LAST_RANK + 1) {
  node_->attachObject(&batch_);
  allBlobs().push_back(this);
}

BlobVisual::~BlobVisual() {
  std::vector<const BlobVisual*>& all = allBlobs();
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
  node_->detachAllObjects();
  node_->getCreator()->destroySceneNode(node_);
}

void BlobVisual::light(const Daylight& daylight, const Haze& haze) {
  material_.light(daylight, daylight.to_sun, haze);
}

void BlobVisual::fill(std::vector<BlobShadow> shadows, const std::string& frame,
                      const terrain::HeightMap& terrain) {
  shadows_ = std::move(shadows);
  frame_ = frame;
  mesh_.clear();
  // Positions are relative to the first shadow: floats are exact enough far from the world origin.
  mesh_.origin = shadows_.empty() ? Vec3(Vec3::Zero()) : shadows_.front().centre;
  node_->setPosition(toOgre(mesh_.origin));
  for (const BlobShadow& shadow : shadows_)
    if (shadow.on_ground) appendShadow(shadow, terrain, mesh_);
  batch_.fill(mesh_);
}

std::vector<const BlobShadow*> BlobVisual::shadowsOf(const Ogre::SceneManager* scene,
                                                     const std::string& frame) {
  std::vector<const BlobShadow*> out;
  for (const BlobVisual* blobs : allBlobs()) {
    if (blobs->node_->getCreator() != scene || blobs->frame_ != frame) continue;
    for (const BlobShadow& shadow : blobs->shadows_) out.push_back(&shadow);
  }
  return out;
}

}  // namespace vegetation_sim::view
