// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "grass/blades/blade_math.h"
#include "vegetation_sim/core/math/random.h"
#include "vegetation_sim/grass/blades/blade_batch.h"

namespace vegetation_sim::grass {

/// Bilinear function over a tile: (base + by_u u) + v (by_v + by_uv u).
template <class T>
struct Bilinear {
  Bilinear() = default;
  explicit Bilinear(const Corners& c, float factor = 1.f)
      : base(T(c[0]) * T(factor)),
        by_u((T(c[1]) - T(c[0])) * T(factor)),
        by_v((T(c[2]) - T(c[0])) * T(factor)),
        by_uv(((T(c[3]) - T(c[2])) - (T(c[1]) - T(c[0]))) * T(factor)) {}
  T at(T u, T v) const { return (base + by_u * u) + v * (by_v + by_uv * u); }
  T base{0}, by_u{0}, by_v{0}, by_uv{0};
};

/// Values that all blades of a tile share at one instant; the factors of a single species are
/// included.
template <class T>
struct TilePlan {
  TilePlan(const Tile& tile, const TileMotion& motion)
      : mixed(tile.species_count > 1),
        south(T(tile.density[0]) + T(tile.density[1])),
        north(T(tile.density[2]) + T(tile.density[3])) {
    const BladeSpecies& s = tile.species[0];
    height = Bilinear<T>(tile.height, mixed ? 1.f : s.height);
    shape = Bilinear<T>(tile.shape, mixed ? 1.f : s.lean);
    wind_x = Bilinear<T>(motion.wind_x, mixed ? 1.f : s.compliance);
    wind_y = Bilinear<T>(motion.wind_y, mixed ? 1.f : s.compliance);
    if (mixed)
      for (std::size_t k = 0; k < static_cast<std::size_t>(tile.species_count); ++k)
        shares[k] = Bilinear<T>(tile.shares[k]);
  }
  bool mixed;
  T south, north;  ///< sums of the densities at the edges
  Bilinear<T> height, shape, wind_x, wind_y;
  std::array<Bilinear<T>, MAX_SPECIES> shares{};
};

/// Increment between the random words of one blade.
constexpr std::uint32_t WORD_STEP = 0x9E3779B9U;

/// Random numbers of a blade, which are functions of the tile's key and the blade's index.
template <class T>
struct BladeRandom {
  BladeRandom(std::uint64_t key, int blade)
      : base(mix32(static_cast<std::uint32_t>(blade) ^ static_cast<std::uint32_t>(key)) +
             static_cast<std::uint32_t>(key >> 32)) {
    const std::uint32_t first = word(0), second = word(1), third = word(2);
    v = T(first >> 8) * T(1.0 / 16777216.0);
    u = T(second >> 8) * T(1.0 / 16777216.0);
    shortness = T(first & 0xff) * T(1.0 / 256.0);
    // Sums of two bytes make small leans likely, large ones rare and no direction special.
    lean_x = T((third & 0xff) + (third >> 8 & 0xff)) * T(1.0 / 255.0) - T(1);
    lean_y = T((third >> 16 & 0xff) + (third >> 24)) * T(1.0 / 255.0) - T(1);
  }
  std::uint32_t word(std::uint32_t i) const { return mix32(base + i * WORD_STEP); }
  /// Returns the number that selects the species. It is never 0, so a share of 0 is never taken.
  T kind() const { return (T(word(3) >> 8) + T(0.5)) * T(1.0 / 16777216.0); }

  std::uint32_t base;
  T u, v, shortness, lean_x, lean_y;
};

/// Maps a uniform number to a place with a density that runs linearly from a to b: the inverse of
/// its cumulative in a form that does not cancel (as pbrt samples bilinear functions).
template <class T>
T linearPlace(T uniform, T a, T b) {
  const T root = std::sqrt(std::max(T(0), a * a + (b - a) * (b + a) * uniform));
  const T below = a + root;
  const T place = below > T(0) ? uniform * (a + b) / below : uniform;
  return std::min(place, T(1.0 - 1.0 / 16777216.0));
}

/// A blade before it is bent.
template <class T>
struct BladeRoot {
  BladeRoot(const Tile& tile, const TilePlan<T>& plan, int blade) : random(tile.key, blade) {
    const Corners& d = tile.density;
    v = linearPlace(random.v, plan.south, plan.north);
    const T west = T(d[0]) + (T(d[2]) - T(d[0])) * v, east = T(d[1]) + (T(d[3]) - T(d[1])) * v;
    u = linearPlace(random.u, west, east);
    if (plan.mixed) chooseSpecies(tile, plan);
    const BladeSpecies& kind = tile.species[static_cast<std::size_t>(species)];
    length = plan.height.at(u, v);
    if (plan.mixed) length = length * T(kind.height);
    length = length * (T(1) - T(kind.spread) * random.shortness);
  }
  void chooseSpecies(const Tile& tile, const TilePlan<T>& plan) {
    const auto last = static_cast<std::size_t>(tile.species_count - 1);
    const T aim = random.kind() * plan.shares[last].at(u, v);
    for (std::size_t s = 1; s <= last; ++s)
      if (aim > plan.shares[s - 1].at(u, v)) species = static_cast<int>(s);
  }
  BladeRandom<T> random;
  T u, v, length;
  int species{0};
};

}  // namespace vegetation_sim::grass
