// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::grass {

/// Daylight on grass as factors on its colours. Upright blades turn their edges to the sun, bent
/// ones their faces, which shine; a gust is thus visible as a wave of light.
struct GrassLight {
  Vec3 to_sun{Vec3(0.5, -0.6, 0.62)};  ///< unit
  /// red, green, blue of the sun; above 1 it is brighter than the colour itself
  Vec3 sun{Vec3(1.46, 1.28, 0.96)};
  Vec3 sky{Vec3(0.50, 0.57, 0.66)};  ///< red, green, blue of the sky
  double shine{0.16};                ///< shine of a blade that leans away from the viewer
};

/// Orientation of a piece of a blade.
struct BladePiece {
  float flat{0.f};     ///< 0 upright to 1 lying
  float facing{0.6f};  ///< how much its broad side faces the sun when upright, 0 to 1
  float away{0.f};     ///< 1: it leans straight away from the viewer, -1: towards it
  float way{1.f};      ///< position along the blade, root 0 to tip 1
};

/// Light on that piece: `factor` on its own colour, and `shine` of the sun's colour.
struct PieceLight {
  float factor[3], shine[3];
};

inline PieceLight lightOn(const GrassLight& light, const BladePiece& piece) {
  const auto up = static_cast<float>(light.to_sun.z());
  const float across = std::sqrt(std::max(0.f, 1.f - up * up));
  const float direct = (1.f - piece.flat) * across * (0.5f + 0.5f * piece.facing) + piece.flat * up;
  // Neighbours shade the roots, less so where blades lie.
  const float depth =
      (1.f - piece.flat) * (0.36f + 0.64f * piece.way) + piece.flat * (0.70f + 0.30f * piece.way);
  const float shine = static_cast<float>(light.shine) * piece.flat * depth *
                      std::max(0.f, 0.55f + 0.45f * piece.away);
  PieceLight out{};
  for (int i = 0; i < 3; ++i) {
    const auto sun = static_cast<float>(light.sun[i]), sky = static_cast<float>(light.sky[i]);
    out.factor[i] = (sun * direct + sky * (0.6f + 0.4f * piece.flat)) * depth;
    out.shine[i] = shine * sun;
  }
  return out;
}

}  // namespace vegetation_sim::grass
