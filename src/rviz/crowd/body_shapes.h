// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "rviz/crowd/body_cover.h"

namespace vegetation_sim::view {

/// Ellipse around an axis of a body, in heights of the person.
struct FormRing {
  double along, broad, deep;  ///< along the axis; half axes to the left and to the front
  double forward{0.0};        ///< of the centre; of shoes upwards
  Cover cover{Cover::SKIN};
  bool fine{false};   ///< is left out of small bodies
  double shade{1.0};  ///< factor of the colour, from folds
};
using FormRings = std::vector<FormRing>;

const FormRings& trunkRings();  ///< from the hips up the spine
const FormRings& headRings();   ///< from the chin up
/// From the shoulder. The hand is flat, its thumb in front. @param bare below the elbows.
const FormRings& armRings(bool bare);
/// From the hip. @param bare below the knees.
const FormRings& legRings(bool bare);
const FormRings& shoeRings();  ///< from the heel to the toes
const FormRings& eyeRings();   ///< outwards
const FormRings& irisRings();  ///< likewise
const FormRings& earRings();   ///< likewise
/// Returns how far a relaxed finger has turned to the palm at a distance beyond its knuckle.
double curlOf(double beyond);
/// From the palm, curved to the front.
FormRings fingerRings(double length, double radius);
/// Returns a skirt from its hem at the knees up to the hips, or a coat.
const FormRings& skirtRings(bool coat);

}  // namespace vegetation_sim::view
