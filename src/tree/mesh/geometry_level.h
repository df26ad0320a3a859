// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::forest {

/// Levels of a tree's mesh, from a few triangles far away (0) to all of them (S1-03, S1-13).
constexpr int GEOMETRY_LEVELS = 6;

/// Detail of one level: topology and shape are simplified (S1-08, S1-09).
struct MeshDetail {
  int depths{MAX_DEPTHS};     ///< recursion depths whose bark is drawn
  int trunk_sides{10};        ///< sides of the trunk's section; each depth has fewer, at least 3
  int sections{16};           ///< maximum number of tube sections of one limb
  double leaf_fraction{1.0};  ///< fraction of leaf clusters, outer ones first
  double leaf_growth{1.0};    ///< size factor of the remaining clusters
  bool boughs{false};         ///< a card shows a whole bough with more and smaller leaves
};
MeshDetail meshDetail(int geometry_level);

/// Returns the level for a tree that is `height_px` pixels high; `current` (-1: none) is kept while
/// the size is within 15 % of the border that it crossed.
int geometryLevel(double height_px, int current);

/// Global factor on projected sizes that controls the complexity of the next frame (S1-14): g <- g
/// (target / actual)^a. The exponent a is halved whenever the target is overshot. If the complexity
/// can only jump over the target, the factor stays on the nearer side until target or scene change.
class ComplexityFeedback {
 public:
  ComplexityFeedback() = default;
  double factor() const { return factor_; }
  /// @param actual complexity of the last frame. @param target in the same unit, > 0.
  void update(double actual, double target);
  void reset() { *this = ComplexityFeedback(); }

 private:
  static constexpr double LARGEST_EXPONENT = 0.5;  // triangles grow about as the square of size

  ComplexityFeedback(double factor, double target) : factor_(factor), target_(target) {}

  double factor_{1.0};
  double exponent_{LARGEST_EXPONENT};
  double target_{0.0};
  double error_{0.0};     // logarithm of target / actual, last time
  double rests_at_{0.0};  // complexity; 0: not settled
};

}  // namespace vegetation_sim::forest
