// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/terrain/height_map.h"

namespace vegetation_sim::terrain {

/// Maximum number of plants in all rows of a layout, and of places of the grid that placeInRows()
/// visits, gaps and places outside the field included.
constexpr int MOST_ROW_PLANTS = 65536, MOST_ROW_PLACES = 1 << 20;
constexpr int MOST_CORNERS = 64;  ///< of a polygon

/// HORIZONTAL: spacings are distances on the map. SLOPE: they are straight distances between
/// neighbours on the ground, as a planter with a chain measures them.
enum class RowSpacing : int { HORIZONTAL = 0, SLOPE = 1 };

/// Plants in parallel rows. Row r and place p of it are numbered from the origin; in a polygon
/// both may be negative. A plant is a pure function of seed, row and place, so that gaps and
/// neighbours do not change it.
struct RowLaw {
  Vec3 origin{Vec3::Zero()};  ///< corner at the start of row 0; z is above the terrain [m]
  double heading{0.0};        ///< direction of the rows, 0 is east; further rows are to the left
  double row_spacing{2.0}, plant_spacing{1.0};  ///< [m]
  RowSpacing spacing{RowSpacing::HORIZONTAL};
  int rows{1}, plants{1};          ///< rows, and plants per row, unless an extent is given
  double width{0.0}, length{0.0};  ///< extent across and along the rows; 0: not given [m]
  double headland{0.0};            ///< free strip at both ends of a row [m]
  double gaps{0.0};                ///< share of places without a plant
  double jitter_along{0.0}, jitter_across{0.0};  ///< largest offset of a plant [m]
  double turn{3.1416};                           ///< largest yaw off the heading [rad]
  double smallest{0.9}, largest{1.1};            ///< scale
  std::vector<Vec3> polygon;  ///< corners of the field instead of rows and plants; z is unused [m]
};
void describe(FieldVisitor& visitor, RowLaw& law);

struct RowPlant {
  int row{0}, place{0};
  Vec3 position{Vec3::Zero()};  ///< z is above the terrain [m]
  double yaw{0.0}, scale{1.0};
  std::uint64_t seed{0};
};

/// Reads the keys of a law and `polygon`, but does not finish the section, which has further keys
/// of the caller.
RowLaw readRowLaw(YamlSection& section);

/// Returns the plants, row by row. Adds a fault to the section if there are more than `most`, or
/// too many places.
std::vector<RowPlant> placeInRows(const RowLaw& law, const HeightMap& ground, std::uint64_t seed,
                                  int most, YamlSection& section);

}  // namespace vegetation_sim::terrain
