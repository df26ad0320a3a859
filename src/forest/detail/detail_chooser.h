// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "forest/detail/tier_predictor.h"
#include "forest/detail/tree_detail.h"

namespace vegetation_sim::forest {

/// Chooses the tier of every tree that a demand requires: the cheapest that holds the tolerance,
/// within the budget. Keeps the results of the last choice for reports and nothing else.
class DetailChooser {
 public:
  /// What modes may be started in a tick. Computing them takes milliseconds, fine ones some tens.
  enum class Start { NONE, PLAIN, ANY };

  /// Starts transitions and modes in `detail`.
  /// @param physical_cost of physical branches, for demands within the frame time [ms].
  void choose(const PredictionContext& context, const DetailDemand& demand, double physical_cost,
              Start allowed, TreeDetail& detail);

  const GovernorFigures& figures() const { return figures_; }
  /// The trees of the choice with their predicted errors; empty if there are very many.
  const std::vector<Plant>& plants() const { return plants_; }
  /// Whether the last choice has started modes.
  bool started() const { return started_; }

 private:
  void findPlants(const PredictionContext& context, const DetailDemand& demand, int last_base,
                  const TreeDetail& detail);
  void addPlant(const TierPredictor& predictor, const PredictionContext& context,
                const DetailDemand& demand, int last_base, const TreeDetail& detail,
                std::uint32_t tree);
  void allocate(const Settings& settings, const DetailDemand& demand, double physical_cost);
  void startModes(const PredictionContext& context, Start allowed, TreeDetail& detail);
  void setLevels(const PredictionContext& context, TreeDetail& detail) const;

  std::vector<Plant> plants_;
  GovernorFigures figures_;
  bool started_{false};
};

}  // namespace vegetation_sim::forest
