// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "grass/mesh/grass_geometry.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::view {

/// Soft ellipse of shadow on the ground.
struct BlobShadow {
  Vec3 centre{Vec3::Zero()};                         ///< on the ground [m]
  Vec3 first{Vec3::UnitX()}, second{Vec3::UnitY()};  ///< half axes along the ground [m]
  /// Horizontal way of the shadow per metre of height above the ground.
  Vec3 slant{Vec3::Zero()};
  double strength{0.5};  ///< share of light that it takes at its centre, 0 to 1
  double height{0.3};    ///< height above the ground at which it has a third of that [m]
  bool on_ground{true};  ///< false: only plants receive it
};

/// Box with any orientation.
struct ShadowBox {
  Vec3 centre{Vec3::Zero()};
  std::array<Vec3, 3> half{};  ///< vectors from the centre to three faces [m]
};
/// Returns the box around a capsule.
ShadowBox capsuleBox(const Vec3& from, const Vec3& to, double radius);

/// Returns the shadow that a box takes from skylight below it, or nothing if it is too high above
/// the ground. @param strength of a box that touches the ground.
std::optional<BlobShadow> contactShadow(const ShadowBox& box, double strength,
                                        const terrain::HeightMap& terrain);
/// Returns the shadow of a box in sunlight, or nothing if it lies too far from the box.
std::optional<BlobShadow> sunShadow(const ShadowBox& box, const Vec3& to_sun, double strength,
                                    const terrain::HeightMap& terrain);

/// Weakens shadows that overlap, so that together they are about as dark as one. The time
/// is quadratic in their number.
void shareDarkness(std::vector<BlobShadow>& shadows);

/// Returns the share of light that a shadow takes at a place above the ground.
double shadeAt(const BlobShadow& shadow, const Vec3& place);

/// Appends a shadow that follows the ground. Its picture is that of blobPicture().
void appendShadow(const BlobShadow& shadow, const terrain::HeightMap& terrain,
                  grass::GrassMesh& mesh);

}  // namespace vegetation_sim::view
