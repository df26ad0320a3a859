// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rviz/crowd/body_details.h"

namespace vegetation_sim::view {

/// Hair or a cap as a shell over the head. Its rings go from the hairline, which each column of
/// vertices has at its own height, to the crown. Column 0 is in front, 6 behind. Hair is parted on
/// the right and not quite even.
class HairForm {
 public:
  static constexpr std::size_t COLUMNS = 7;
  /// Angles of the columns from the front [degree].
  static constexpr double COLUMN_ANGLES[COLUMNS] = {0.0, 25.0, 53.0, 87.0, 118.0, 149.0, 180.0};

  explicit HairForm(crowd::HairCut cut);

  /// Returns the ring from which a vertex has its place. @param ring below rings().
  FormRing at(std::size_t ring, std::size_t vertex) const;
  std::size_t rings() const;
  /// Returns the height from which the head itself has the colour of hair in a direction.
  double edgeAt(const Around& around) const;
  bool isBald() const { return cut_ == crowd::HairCut::BALD; }
  /// Returns a tail behind the head as rings from its end up, or none.
  static const FormRings& tailRings(crowd::HairCut cut);

 private:
  crowd::HairCut cut_;
};

}  // namespace vegetation_sim::view
