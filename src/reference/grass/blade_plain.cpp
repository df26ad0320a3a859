// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grass/blade_plain.h"

#include "grass/blades/blade_placement.h"
#include "reference/grass/blade_profile.h"

namespace vegetation_sim::grass {
namespace {

template <class T>
struct Plane {
  T x, y;
};

// Size and direction of the sum of the bends at rest and by wind, which is bounded (S2-W4, E16).
template <class T>
struct Bend {
  T size;
  Plane<T> direction;
};

template <class T>
T bounded(T size) {
  if (!(size > T(BEND_KNEE))) return size;
  const T room = T(BEND_LIMIT - BEND_KNEE), excess = (size - T(BEND_KNEE)) / room;
  return T(BEND_KNEE) + room * (excess / std::sqrt(T(1) + excess * excess));
}

template <class T>
Bend<T> directed(T x, T y) {
  const T size = std::sqrt(x * x + y * y);
  if (!(size > T(0))) return {T(0), {T(1), T(0)}};
  const T inverse = T(1) / size;
  return {size, {x * inverse, y * inverse}};
}

template <class T>
Bend<T> bendOf(const Tile& tile, const TilePlan<T>& plan, const BladeRoot<T>& root) {
  T lean = plan.shape.at(root.u, root.v);
  T x = plan.wind_x.at(root.u, root.v), y = plan.wind_y.at(root.u, root.v);
  if (plan.mixed) {
    const BladeSpecies& kind = tile.species[static_cast<std::size_t>(root.species)];
    lean = lean * T(kind.lean);
    x = x * T(kind.compliance);
    y = y * T(kind.compliance);
  }
  Bend<T> bend = directed(lean * root.random.lean_x + x, lean * root.random.lean_y + y);
  bend.size = bounded(bend.size);
  return bend;
}

// Position of (u, v) in a grid of cells.
template <class T>
struct CellPlace {
  CellPlace(T u, T v, int cells) : side(cells + 1) {
    const T a = u * T(cells), b = v * T(cells);
    const int column = std::min(static_cast<int>(a), cells - 1);
    const int row = std::min(static_cast<int>(b), cells - 1);
    index = row * side + column;
    p = a - T(column);
    q = b - T(row);
  }
  T at(const std::vector<float>& grid) const {
    const float* low = grid.data() + index;
    const float* high = low + side;
    return (T(low[0]) * (T(1) - p) + T(low[1]) * p) * (T(1) - q) +
           (T(high[0]) * (T(1) - p) + T(high[1]) * p) * q;
  }
  int side, index;
  T p, q;
};

template <class T>
struct Bent {
  T hinge, arc;
  Plane<T> direction;
};

// Adds the crush. The more a blade is crushed, the more of its bend is in the hinge.
template <class T>
Bent<T> trodden(const Bend<T>& bend, const CrushPatch& crush, T u, T v) {
  const CellPlace<T> place(u, v, crush.cells);
  const T tilt = place.at(crush.tilt), tx = place.at(crush.tx), ty = place.at(crush.ty);
  const T along = std::sqrt(tx * tx + ty * ty);
  const T scale = along > T(0) ? tilt / along : T(0);
  const T left = bend.size * (T(1) - tilt * T(1.0 / BEND_LIMIT));
  const Bend<T> both =
      directed(tx * scale + bend.direction.x * left, ty * scale + bend.direction.y * left);
  const T part = tilt + left;
  const T hinge = part > T(0) ? both.size * (tilt / part) : T(0);
  return {hinge, both.size - hinge, both.direction};
}

// Ground under a blade: height of its root and slope along x and y.
template <class T>
struct Ground {
  T z{0}, slope_x{0}, slope_y{0};
};

template <class T>
Ground<T> groundAt(const Tile& tile, T u, T v) {
  if (!tile.sloped) return {};
  const CellPlace<T> c(u, v, tile.ground_cells);
  const float* low = tile.ground.data() + c.index;
  const float* high = low + c.side;
  const T per_metre = T(tile.ground_cells) / T(tile.size);
  const T east = (T(low[1]) - T(low[0])) * (T(1) - c.q) + (T(high[1]) - T(high[0])) * c.q;
  const T north = (T(high[0]) - T(low[0])) * (T(1) - c.p) + (T(high[1]) - T(low[1])) * c.p;
  return {c.at(tile.ground), east * per_metre, north * per_metre};
}

// Places the points: reach goes along the ground and rise perpendicular to it, so that no slope
// cuts a blade.
template <class T, class Put>
void place(const Tile& tile, const BladeRoot<T>& root, const Bent<T>& bent,
           const Profile<T>& profile, Put&& put) {
  const Ground<T> ground = groundAt(tile, root.u, root.v);
  const T x = root.u * T(tile.size), y = root.v * T(tile.size);
  T tx = bent.direction.x, ty = bent.direction.y, tz = T(0), nx = T(0), ny = T(0), nz = T(1);
  if (tile.sloped) {
    const T climb = ground.slope_x * tx + ground.slope_y * ty;
    const T shrink = T(1) / std::sqrt(T(1) + climb * climb);
    tx = tx * shrink;
    ty = ty * shrink;
    tz = climb * shrink;
    const T square = ground.slope_x * ground.slope_x + ground.slope_y * ground.slope_y;
    nz = T(1) / std::sqrt(T(1) + square);
    nx = T(0) - ground.slope_x * nz;
    ny = T(0) - ground.slope_y * nz;
  }
  for (std::size_t i = 0; i < POINTS; ++i) {
    const T reach = profile.reach[i], rise = profile.rise[i];
    put(i, x + reach * tx + rise * nx, y + reach * ty + rise * ny,
        ground.z + reach * tz + rise * nz);
  }
}

template <class T, class Put>
void poseOne(const Tile& tile, const TilePlan<T>& plan, const TileMotion& motion, int blade,
             Put&& put) {
  BladeRoot<T> root(tile, plan, blade);
  if (motion.crush && !motion.crush->cut.empty())
    root.length =
        std::min(root.length, T(motion.crush->cut[motion.crush->nearest(
                                  static_cast<float>(root.u), static_cast<float>(root.v))]));
  const Bend<T> bend = bendOf(tile, plan, root);
  Bent<T> bent{T(0), bend.size, bend.direction};
  if (motion.crush && motion.crush->cells > 0) bent = trodden(bend, *motion.crush, root.u, root.v);
  place(tile, root, bent, bladeProfile(root.length, bent.hinge, bent.arc, motion.model), put);
}

}  // namespace

void poseBladesPlain(const Tile& tile, const TileMotion& motion, int count, BladeBlock* out) {
  const TilePlan<float> plan(tile, motion);
  for (int blade = 0; blade < blocksFor(count) * BLOCK; ++blade) {
    BladeBlock& block = out[blade / BLOCK];
    const int lane = blade % BLOCK;
    poseOne<float>(tile, plan, motion, blade, [&](std::size_t i, float x, float y, float z) {
      block.x[i][lane] = x;
      block.y[i][lane] = y;
      block.z[i][lane] = z;
    });
  }
}

ReferenceBlade poseReference(const Tile& tile, const TileMotion& motion, int blade) {
  ReferenceBlade out;
  poseOne<double>(tile, TilePlan<double>(tile, motion), motion, blade,
                  [&](std::size_t i, double x, double y, double z) {
                    out.x[i] = x;
                    out.y[i] = y;
                    out.z[i] = z;
                  });
  return out;
}

BladeTraits traitsOf(const Tile& tile, int blade) {
  const BladeRoot<float> root(tile, TilePlan<float>(tile, TileMotion()), blade);
  return {root.u, root.v, root.length, root.species,
          Bilinear<float>(tile.colour).at(root.u, root.v)};
}

}  // namespace vegetation_sim::grass
