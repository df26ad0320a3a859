// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forest/detail/detail_demand.h"
#include "forest/detail/tree_errors.h"
#include "vegetation_sim/tree/growth/skeleton.h"
#include "vegetation_sim/wind/field.h"

namespace vegetation_sim::forest {

/// The inputs of predictions at one tick.
struct PredictionContext {
  const Layout& layout;
  const terrain::HeightMap& terrain;
  const wind::Field& wind;
  const Settings& settings;
  TreeErrors& errors;  ///< computes response errors when they are first needed
  Nanoseconds stamp;
  const BrokenTrees* broken{nullptr};  ///< what has come off the trees; null: nothing
};

/// Predicts the errors and costs of the tiers of trees in the wind of one tick, and which tier the
/// tolerance requires.
class TierPredictor {
 public:
  explicit TierPredictor(const PredictionContext& context)
      : context_(context),
        now_(context.wind.at(context.stamp)),
        steady_(now_.steadyBound()),
        swinging_(context.wind, context.stamp) {}

  /// Returns whether all trees of a region may stand still for a demand.
  bool mayRest(const Ball& region, const DetailDemand& demand) const;
  /// Predicts for a tree whose `held` tier is set. Returns false if the tree is at the base level
  /// of the demand and stays there; the plant then has no errors.
  bool predict(const TreeSeed& seed, const DetailDemand& demand, Plant& plant) const;

 private:
  void requestModes(const PredictedError& off, Plant& plant) const;
  PredictedError responseErrorOf(const TreeSeed& seed, const wind::GustSpectrum& spectrum,
                                 double bending, double pixels) const;
  double bendingSpeed(double speed, double reference_speed) const;
  bool haveModes() const;

  PredictionContext context_;
  wind::Instant now_;
  double steady_;                     // part of the bound of speed that is the same everywhere
  wind::GustSpectrumField swinging_;  // now
};

}  // namespace vegetation_sim::forest
