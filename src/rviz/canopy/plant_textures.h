// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "rviz/textures/image.h"
#include "vegetation_sim/canopy/canopy_layout.h"

namespace vegetation_sim::view {

/// The textures of the meshes of a layout (S3-29), beside the painted leaves of the atlas. A
/// texture that cannot be read is replaced by the plain picture.
class PlantTextures {
 public:
  explicit PlantTextures(const canopy::Layout& layout);

  /// Returns the painted leaves and the textures as one atlas with mipmaps.
  std::vector<Image> atlas(int edge) const;
  bool empty() const { return pictures_.empty(); }
  /// Look of the faces of a material.
  struct Look {
    int place{-1};  ///< in the atlas; -1: no texture
    Vec3 colour{Vec3::Ones()};
    Vec3 mean{Vec3::Ones()};  ///< colour of its faces from afar
  };
  const Look& lookOf(std::size_t kind, std::size_t material) const {
    return looks_[kind][material];
  }
  /// Texts for the user, each with the name of the kind and of the texture.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  int addPicture(const std::string& kind, const canopy::FaceMaterial& material, Vec3& mean);

  std::vector<std::vector<Look>> looks_;  // by kind and material
  std::vector<Image> pictures_;
  std::vector<std::string> faults_;
};

}  // namespace vegetation_sim::view
