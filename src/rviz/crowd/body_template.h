// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rviz/crowd/body_form.h"

namespace vegetation_sim::view {

/// Vertex of the skin in the pose of a BodyForm, in heights of the person.
struct SkinVertex {
  Vec3 position, normal;
  std::array<std::uint8_t, 2> bones{};  ///< as Bone
  double second{0.0};                   ///< weight of the second bone; the first has the rest
  /// Moves of the most stout body, and of the builds with the broadest hips and shoulders.
  Vec3 full{Vec3::Zero()}, hips{Vec3::Zero()}, shoulders{Vec3::Zero()};
  Vec3 tucked{Vec3::Zero()};  ///< move where a top is tucked in
  double open{1.0};           ///< share of the sky that the body itself leaves free
  double shade{1.0};          ///< factor of the colour, from folds of clothes
  Cover cover{Cover::SKIN};
};
constexpr std::size_t MOST_SIDES = 12;
/// Ring of vertices. Consecutive rings are joined.
struct SkinRing {
  std::array<SkinVertex, MOST_SIDES> vertices;
  bool begins{false};             ///< is not joined to the ring before
  bool fine{false};               ///< is left out of small bodies
  bool close{false};              ///< is left out of bodies with fewer sides
  std::size_t sides{MOST_SIDES};  ///< of close rings
};
using SkinRings = std::vector<SkinRing>;
/// Returns the skin of a person without the head; it is made once per process.
const SkinRings& bodyTemplate(crowd::Outfit outfit, bool long_sleeves);
/// Returns the head, likewise.
const SkinRings& headTemplate(crowd::HairCut cut);

}  // namespace vegetation_sim::view
