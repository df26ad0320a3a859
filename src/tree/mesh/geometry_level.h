// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/tree/growth/species.h"

namespace vegetation_sim::forest {

/// Levels of a tree's mesh, from a few triangles far away (0) to all of it (S1-03, S1-13).
constexpr int GEOMETRY_LEVELS = 6;

/// What one level draws: topology as well as shape is simplified (S1-08, S1-09).
struct MeshDetail {
  int depths{MAX_DEPTHS};     ///< recursion depths whose bark is drawn
  int trunk_sides{10};        ///< of the trunk's section; each depth has fewer, at least 3
  int sections{16};           ///< most tube sections of one limb
  double leaf_fraction{1.0};  ///< of the leaf clusters, outer ones rather than inner ones
  double leaf_growth{1.0};    ///< of the size of those that stay
  bool boughs{false};         ///< a card shows a whole bough: more and smaller leaves
};
MeshDetail meshDetail(int geometry_level);

/// Level for a tree that is `height_px` pixels high; `current` (-1: none) is kept while the size is
/// within 15 % of the border that it crossed.
int geometryLevel(double height_px, int current);

/// Global factor on projected sizes that steers the complexity of the next frame to a target
/// (S1-14): g <- g (target / actual)^a. The exponent a is halved whenever the target is overshot.
/// Where a complexity can only jump over the target, the factor comes to rest on the nearer side
/// and stays there until the target or the scene changes.
class ComplexityFeedback {
 public:
  ComplexityFeedback() = default;
  double factor() const { return factor_; }
  /// @param actual complexity of the last frame. @param target wanted, both in the same unit, > 0.
  void update(double actual, double target);
  void reset() { *this = ComplexityFeedback(); }

 private:
  static constexpr double LARGEST_EXPONENT = 0.5;  // triangles grow about as the square of size

  ComplexityFeedback(double factor, double target) : factor_(factor), target_(target) {}

  double factor_{1.0};
  double exponent_{LARGEST_EXPONENT};
  double target_{0.0};
  double error_{0.0};     // logarithm of target / actual, last time
  double rests_at_{0.0};  // complexity; 0: it does not rest
};

}  // namespace vegetation_sim::forest
