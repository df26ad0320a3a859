// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/grass/grass_stand.h"

#include <algorithm>
#include <cmath>

#include "sensors/grass/blade_width.h"

namespace vegetation_sim::scan {

void GrassStand::add(const Kind& kind) {
  kinds_[count_++] = kind;
  top_ = std::max(top_, kind.rise * std::min(double{kind.most}, cut_));
}

// Blades are taken as straight from root to tip and equally wide from all sides, as they are drawn.
double GrassStand::extinction(double height, double steep) const {
  if (!(height >= 0.0 && height <= top_ && height < cut_)) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < count_; ++k) {
    const Kind& kind = kinds_[k];
    const double rise = kind.rise, squared = rise * rise;
    // Mean squared cosine between the ray and blades of random direction.
    const double along = squared * steep + 0.5 * (1.0 - squared) * (1.0 - steep);
    sum += kind.per_width * widthAfterCut(height / rise, kind.least, kind.most, cut_) *
           std::sqrt(1.0 - along);
  }
  return sum;
}

}  // namespace vegetation_sim::scan
