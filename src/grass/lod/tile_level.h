// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::grass {

/// What a tile is drawn as (paper 2, section 3): each shows all that the one before does, and more.
enum class TileModel : int { TEXTURE = 0, STRIPS = 1, BLADES = 2 };

/// What the coarser tiers leave out of a tile, as lengths [m]: strips the places of single blades,
/// a texture the height of the grass.
struct TileDetail {
  double blade_spacing{0.05};  ///< mean distance of neighbours, 1 / sqrt(density)
  double height{0.3};
};

/// What a tier leaves out of a tile [m].
double omission(const TileDetail& detail, TileModel tier);

/// Coarsest tier whose omission [pixel] holds the tolerance (S2-15), with the hysteresis of the
/// forest: `current` is kept until the next coarser one is well within it.
TileModel chooseTileModel(const TileDetail& detail, double pixels_per_metre, double tolerance,
                          TileModel current);

/// Share of the blades to draw, and how much wider these are made: fewer where single blades can
/// hardly be told apart. 1 near, never below LEAST_SHARE.
double bladeShare(const TileDetail& detail, double pixels_per_metre, double tolerance);
constexpr double LEAST_SHARE = 0.125;

/// Segments of a blade: LINKS near, fewer where the chords of a blade bent to the ground are within
/// the tolerance of it (S2-08).
int bladeSegments(double height, double pixels_per_metre, double tolerance);

/// Level of one tile as a function of time: its place on the ladder, 0 (texture) to 2 (blades), was
/// `place` at `since` and moves towards `target` at constant speed; it can turn round anywhere.
struct TileModelState {
  TileModel target{TileModel::TEXTURE};
  Nanoseconds since{0};
  float place{0.f};
};
/// @param transition time from one tier to the next [s]; 0: at once.
double placeAt(const TileModelState& state, Nanoseconds stamp, double transition);
void setTileModel(TileModelState& state, TileModel target, Nanoseconds stamp, double transition);

/// How a tile looks between two tiers.
struct Morph {
  bool blades{false};   ///< any are drawn
  double slide{0.0};    ///< 0: blades at their places, 1: all on the edges of the tile (S2-12)
  double strip{0.0};    ///< height of the strips / height of the grass (S2-12, S2-14)
  double texture{1.0};  ///< the ground is always there (S2-13)
};
Morph morphAt(double place);

/// Layers parallel to the ground that stand in for strips where the grass is seen from above
/// (S2-W3): their weight by the elevation of the view [rad], and how many by distance.
double layerWeight(double elevation);
int layerCount(double height, double pixels_per_metre, double tolerance);
constexpr int MOST_LAYERS = 12;

}  // namespace vegetation_sim::grass
