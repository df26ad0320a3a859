// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::grass {

/// Models of a tile (paper 2, section 3). Each shows all that the one before shows, and more.
enum class TileModel : int { TEXTURE = 0, STRIPS = 1, BLADES = 2 };

/// Lengths that the coarser models omit [m]: strips omit the places of single blades, a texture the
/// height of the grass.
struct TileDetail {
  double blade_spacing{0.05};  ///< mean distance of neighbouring blades, 1 / sqrt(density)
  double height{0.3};
};

/// Returns the omission of a model [m].
double omission(const TileDetail& detail, TileModel tier);

/// Returns the coarsest model whose omission [pixel] is within the tolerance (S2-15), with the
/// hysteresis of the forest: `current` is kept until the next coarser one is well within it.
TileModel chooseTileModel(const TileDetail& detail, double pixels_per_metre, double tolerance,
                          TileModel current);

/// Returns the share of the blades to draw; they are drawn wider by its inverse. It is 1 near the
/// viewer and smaller where blades cannot be distinguished, but never below LEAST_SHARE.
double bladeShare(const TileDetail& detail, double pixels_per_metre, double tolerance);
constexpr double LEAST_SHARE = 0.125;

/// Returns the number of segments of a blade: LINKS near the viewer, fewer where the chords of a
/// fully bent blade are within the tolerance (S2-08).
int bladeSegments(double height, double pixels_per_metre, double tolerance);

/// Transition between models as a function of time. The position on the ladder from 0 (texture) to
/// 2 (blades) was `place` at `since` and moves towards `target` at constant speed; it can reverse
/// at any time.
struct TileModelState {
  TileModel target{TileModel::TEXTURE};
  Nanoseconds since{0};
  float place{0.f};
};
/// Returns the position at a stamp. @param transition time from one model to the next [s]; 0: at
/// once.
double placeAt(const TileModelState& state, Nanoseconds stamp, double transition);
void setTileModel(TileModelState& state, TileModel target, Nanoseconds stamp, double transition);

/// Appearance of a tile between two models.
struct Morph {
  bool blades{false};   ///< blades are drawn
  double slide{0.0};    ///< 0: blades at their places, 1: all on the edges of the tile (S2-12)
  double strip{0.0};    ///< height of the strips / height of the grass (S2-12, S2-14)
  double texture{1.0};  ///< weight of the ground texture, always 1 (S2-13)
};
Morph morphAt(double place);

/// Layers parallel to the ground replace strips where grass is seen from above (S2-W3).
/// layerWeight() returns their weight by the elevation of the view [rad], layerCount() their number
/// by scale.
double layerWeight(double elevation);
int layerCount(double height, double pixels_per_metre, double tolerance);
constexpr int MOST_LAYERS = 12;

}  // namespace vegetation_sim::grass
