// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/core/config/yaml.h"
#include "vegetation_sim/core/math/time.h"
#include "vegetation_sim/grass/tread/tread_law.h"

namespace vegetation_sim::grass {

/// A disc that colours the grass, strongest in its middle, such as a mown, dry or fertilised patch.
/// It may move over the terrain, as primitives of wind do (paper 2, section 4.1).
struct ColourMask {
  Point centre{};      ///< at the stamp of its list [m]
  double radius{1.0};  ///< [m]
  double colour{1.0};  ///< colour of the disc, 0 fresh to 1 dry
  double weight{1.0};  ///< weight relative to the grass, which has 1
  Point velocity{};    ///< [m/s]
};
void describe(FieldVisitor& visitor, ColourMask& mask);
/// Returns the weight of a mask at a place.
double weightAt(const ColourMask& mask, double x, double y);
/// Returns the mean of a colour and of those of all masks at a place (S2-18).
double averageColour(double colour, const std::vector<ColourMask>& masks, double x, double y);

/// Discs that colour a meadow, where they are at a stamp.
struct ColourMasks {
  static constexpr std::size_t MOST = 256;
  Nanoseconds stamp{0};
  std::vector<ColourMask> list;

  std::vector<ColourMask> at(Nanoseconds when) const;
};
/// Adds a fault for each value that is out of range, and for too many masks.
void check(const ColourMasks& masks, Faults& faults);
/// Reads the list `colours` of a section.
std::vector<ColourMask> readColourMasks(YamlSection& section);

}  // namespace vegetation_sim::grass
