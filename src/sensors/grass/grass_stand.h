// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "vegetation_sim/grass/map/feature_map.h"

namespace vegetation_sim::scan {

/// Edge of the cells of the grass [m]. All of a column of cells has the grass of its middle.
constexpr double GRASS_CELL = 0.05;

/// Grass of one column of cells as a medium.
class GrassStand {
 public:
  /// Blades of one species.
  struct Kind {
    float per_width{0.f};         ///< width of all blades per area of ground and rise [1/m]
    float rise{1.f};              ///< height of a tip over the length of the blade
    float least{0.f}, most{0.f};  ///< lengths of the blades [m]
  };
  /// @param cut length of stubble, grass::UNCUT if there is none [m].
  explicit GrassStand(double cut) : cut_(cut) {}
  GrassStand() = default;
  void add(const Kind& kind);
  /// Returns the extinction at a height above the ground for rays with a squared vertical component
  /// of the direction [1/m].
  double extinction(double height, double steep) const;

 private:
  double cut_{0.0}, top_{0.0};
  std::uint32_t count_{0};
  std::array<Kind, grass::MAX_SPECIES> kinds_;
};

/// Stands that one thread has evaluated, as many as fit into a processor's cache. Those in the same
/// place of the table replace each other.
class StandCache {
 public:
  StandCache() : entries_(SIZE) {}
  /// @param version of the grass, above 0. @param evaluate returns the stand.
  template <class Evaluate>
  const GrassStand& at(std::uint64_t version, std::int32_t x, std::int32_t y, Evaluate&& evaluate) {
    Entry& entry = entries_[placeOf(x, y)];
    if (entry.version != version || entry.x != x || entry.y != y)
      entry = {version, x, y, evaluate()};
    return entry.stand;
  }

 private:
  static constexpr std::size_t SIDE = 128, SIZE = SIDE * SIDE;
  struct Entry {
    std::uint64_t version{0};
    std::int32_t x{0}, y{0};
    GrassStand stand;
  };
  static std::size_t placeOf(std::int32_t x, std::int32_t y) {
    return static_cast<std::size_t>(y) % SIDE * SIDE + static_cast<std::size_t>(x) % SIDE;
  }
  std::vector<Entry> entries_;
};

}  // namespace vegetation_sim::scan
