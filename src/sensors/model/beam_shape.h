// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "vegetation_sim/core/config/fields.h"

namespace vegetation_sim::scan {

/// Width of a beam, its rays, and the distance at which its hits are separate echoes.
struct BeamShape {
  double divergence{0.0};  ///< full angle of the cone [rad]
  int samples{1};          ///< rays that sample the cone: 1, 7, 19 or 37
  double separation{0.5};  ///< Hits that are nearer to each other are one echo [m].
};
void describe(FieldVisitor& visitor, BeamShape& shape);
/// Adds a fault if `samples` is none of its values.
void check(const BeamShape& shape, const std::string& context, Faults& faults);

/// The rays of a beam: one on the axis, and hexagonal rings of 6, 12 and 18 around it. All stand
/// for equal parts of the cone's solid angle; a ring lies where it halves the part of its rays.
class BeamPattern {
 public:
  explicit BeamPattern(const BeamShape& shape);

  int rays() const { return static_cast<int>(across_.size()); }
  /// Returns the unit vector of a ray; that of ray 0 is `axis`, which must be a unit vector.
  Vec3 direction(const Vec3& axis, int ray) const;

 private:
  struct Offset {
    double u, v;
  };
  std::vector<Offset> across_;  ///< tangents of the angles
};

}  // namespace vegetation_sim::scan
