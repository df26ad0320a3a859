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
  /// Which modes may be started in a tick. Computing them takes milliseconds, fine ones some tens.
  struct Start {
    bool fine;                 ///< fine modes too, not only plain ones
    bool compute;              ///< also modes that `known` does not have
    const ModalForest* known;  ///< shares its computed modes; may be null
  };

  /// Starts transitions and modes in `detail`.
  /// @param physical_cost of physical branches, for demands within the frame time [ms].
  void choose(const PredictionContext& context, const DetailDemand& demand, double physical_cost,
              const Start& start, TreeDetail& detail);

  const GovernorFigures& figures() const { return figures_; }
  /// The trees of the choice with their predicted errors; empty if there are very many.
  const std::vector<Plant>& plants() const { return plants_; }
  /// Returns whether the last choice has computed modes.
  bool hasComputed() const { return has_computed_; }

 private:
  void findPlants(const PredictionContext& context, const DetailDemand& demand, int last_base,
                  const TreeDetail& detail);
  void addPlant(const TierPredictor& predictor, const PredictionContext& context,
                const DetailDemand& demand, int last_base, const TreeDetail& detail,
                std::uint32_t tree);
  void allocate(const Settings& settings, const DetailDemand& demand, double physical_cost);
  void startModes(const PredictionContext& context, const Start& start, TreeDetail& detail);
  void setLevels(const PredictionContext& context, TreeDetail& detail) const;

  std::vector<Plant> plants_;
  GovernorFigures figures_;
  bool has_computed_{false};
};

}  // namespace vegetation_sim::forest
