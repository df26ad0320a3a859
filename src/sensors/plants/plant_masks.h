// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sensors/geometry/strip.h"
#include "terrain/opacity_mask.h"
#include "vegetation_sim/canopy/canopy_layout.h"

namespace vegetation_sim::scan {

/// Where the faces of a kind of plant are transparent, by the alpha of their textures (S3-29).
struct KindMasks {
  std::shared_ptr<const canopy::Form> form;
  std::vector<std::shared_ptr<const terrain::OpacityMask>> of_material;  ///< null: opaque

  /// Returns whether a face is transparent at a place on it. @param strip the face where it is now.
  bool isHole(const canopy::Leaf& face, const Strip& strip, const Vec3& place) const;
};

/// The masks of the textures of all meshes of a layout, each read once. Faces whose texture cannot
/// be read are opaque.
class PlantMasks {
 public:
  static constexpr int MOST_MASKS = 64;  ///< textures with alpha

  PlantMasks() = default;
  explicit PlantMasks(const canopy::Layout& layout);

  /// Returns whether they were read from the textures of a layout: files may have changed although
  /// the hash of the layout has not.
  bool areOf(const canopy::Layout& layout) const;
  /// Returns the masks of a kind, or null if all its faces are opaque.
  std::shared_ptr<const KindMasks> of(std::size_t kind) const {
    return kind < kinds_.size() ? kinds_[kind] : nullptr;
  }
  /// Texts for the user, each with the name of the kind and of the texture.
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  using Mask = std::shared_ptr<const terrain::OpacityMask>;
  Mask read(const std::string& kind, const canopy::FaceMaterial& material);

  std::vector<std::shared_ptr<const std::string>> pictures_;  // of all materials with a texture
  std::vector<std::shared_ptr<const KindMasks>> kinds_;
  std::vector<std::string> faults_;
  int count_{0};  // masks
};

}  // namespace vegetation_sim::scan
