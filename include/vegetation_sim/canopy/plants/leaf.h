// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// A leaf, a piece of a ribbon or a face of a mesh at rest in the world: a quadrilateral strip from
/// root to tip.
struct Leaf {
  /// Root of a connected group of leaves, which alone selects the layer (S3-03) [m].
  Vec3 anchor{Vec3::Zero()};
  Vec3 root{Vec3::Zero()}, tip{Vec3::Zero()};  ///< [m]
  Vec3 side{Vec3::Zero()};                     ///< half of the width [m]
  float root_width{0.6F};                      ///< widths of the strip's ends, relative to `side`
  float tip_width{0.6F};
  float shade{0.0F};      ///< mix of colour and colour_young
  float light{1.0F};      ///< share of the daylight; less inside and below (S3-W5)
  bool joined{false};     ///< a triangle (tip_width 0) that shares corners with other faces
  bool lies{false};       ///< was cut off and lies on the ground: neither wind nor bodies move it
  std::uint32_t look{0};  ///< 1 + index in Form::looks; 0: the look of its kind
};

/// A straight rigid part.
struct Stem {
  Vec3 from, to;  ///< [m]
  double radius;  ///< [m]
};

/// A grown plant, in the world.
struct GrownPlant {
  std::vector<Leaf> leaves;
  std::vector<Stem> stems;
  std::vector<Leaf> rigid;  ///< faces that are never displaced (S3-02)
};

/// How a face of a mesh looks (S3-29). Its corners are those of the strip: root - side, root +
/// side, tip.
struct FaceLook {
  std::array<std::array<float, 2>, 3> uv{};  ///< places in the texture, from its lower left corner
  std::array<float, 3> normal{};             ///< unit; zero: that of the face
  std::uint16_t material{0};                 ///< index in Form::materials
};

/// A material of a mesh.
struct FaceMaterial {
  Vec3 colour{Vec3::Ones()};                   ///< red, green, blue; multiplies the texture
  std::string texture;                         ///< file as the mesh names it; empty: none
  std::shared_ptr<const std::string> picture;  ///< bytes of that file; null: none or not read
  std::string fault;                           ///< why there is no picture
};

/// Leaves and rigid faces of a file, scaled to height 1, with the foot at the origin.
struct Form {
  std::vector<Leaf> leaves, rigid;
  std::vector<FaceLook> looks;  ///< of faces whose material has a colour or a texture
  std::vector<FaceMaterial> materials;
  double radius{0.0};     ///< radius of the circle about the foot that contains everything
  std::uint64_t hash{0};  ///< hash of the leaves and faces, not of their looks
};

}  // namespace vegetation_sim::canopy
