// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <string>
#include <vector>

#include "crowd/body/body_skeleton.h"
#include "ros/replicas/subscribed_crowd.h"
#include "rviz/ground/blob_visual.h"
#include "rviz/render/grass_batch.h"
#include "rviz/render/material.h"
#include "rviz/render/texture.h"
#include "rviz/trees/tree_set.h"

namespace vegetation_sim::view {

/// Figures of the last update.
struct CrowdReport {
  std::size_t people{0}, drawn{0};  ///< in the message; in the picture
  std::size_t triangles{0};
  int rebuilds{0};  ///< number of meshes built
};

/// The OGRE objects of people, which it owns: bodies in one batch, shadows in a second, contact
/// shadows in a third. Render thread only.
class CrowdVisual {
 public:
  struct Options {
    std::size_t most_people{500};
    float detail{1.f};  ///< factor of the size from which detail follows
    bool shadows{true}, contact_shadows{true};
  };

  /// @param parent node in the frame of the people.
  explicit CrowdVisual(Ogre::SceneNode& parent);
  ~CrowdVisual();
  CrowdVisual(const CrowdVisual&) = delete;
  CrowdVisual& operator=(const CrowdVisual&) = delete;

  /// Draws the people of the newest message as they are at a stamp, if anything has changed since
  /// the last call.
  void update(const SubscribedCrowd& crowd, Nanoseconds stamp, const terrain::HeightMap& terrain,
              const View& view, const Options& options);
  void light(const Daylight& daylight, const Haze& haze);
  /// Builds the meshes again at the next update.
  void repaint() { drawn_ = -1; }

  const CrowdReport& report() const { return report_; }

 private:
  using Person = SubscribedCrowd::Person;
  std::vector<const Person*> select(const SubscribedCrowd& crowd, const View& view,
                                    std::size_t most) const;
  static Person extrapolatePerson(const Person& person, const terrain::HeightMap& terrain,
                                  double seconds);
  void addPerson(const Person& person, const SubscribedCrowd& crowd,
                 const terrain::HeightMap& terrain, const View& view, const Options& options);
  void addShadow(const Person& person, const terrain::HeightMap& terrain,
                 const crowd::Skeleton& skeleton);
  void addContacts(const Person& person, const terrain::HeightMap& terrain,
                   const crowd::Skeleton& skeleton, const Options& options);

  Ogre::SceneNode* node_;  // Ogre's; destroyed by us
  Texture shadow_texture_;
  Material body_material_, shadow_material_;
  GrassBatch bodies_, shadows_;
  grass::GrassMesh body_mesh_, shadow_mesh_;
  BlobVisual contacts_;
  std::vector<BlobShadow> blobs_;  // of contacts_, while they are collected
  Daylight daylight_;
  int drawn_{-1};  // SubscribedCrowd::changes()
  Nanoseconds stamp_{0};
  std::string frame_;
  Vec3 eye_{Vec3::Zero()}, forward_{Vec3::Zero()};
  CrowdReport report_;
};

}  // namespace vegetation_sim::view
