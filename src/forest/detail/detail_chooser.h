// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "forest/detail/modes_worker.h"
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
    ModesWorker* worker;       ///< computes the modes of large trees, and others in advance
  };
  /// Trees with more branches are large: their modes start a fixed time after they are requested,
  /// in which another thread computes them.
  static constexpr double LARGE = 1000.0;

  /// Starts transitions and modes in `detail`.
  /// @param physical_cost of physical branches, for demands within the frame time [ms].
  void choose(const PredictionContext& context, const DetailDemand& demand, double physical_cost,
              const Start& start, TreeDetail& detail);

  const GovernorFigures& figures() const { return figures_; }
  /// The trees of the choice with their predicted errors; empty if there are very many.
  const std::vector<Plant>& plants() const { return plants_; }
  /// Returns whether the last choice has computed modes.
  bool hasComputed() const { return has_computed_; }
  /// The computations of the worker that the next choices may need.
  const std::set<ModesWorker::Key>& awaited() const { return awaited_; }

 private:
  void findPlants(const PredictionContext& context, const DetailDemand& demand, int last_base,
                  const TreeDetail& detail);
  void addPlant(const TierPredictor& predictor, const PredictionContext& context,
                const DetailDemand& demand, int last_base, const TreeDetail& detail,
                std::uint32_t tree);
  void allocate(const Settings& settings, const DetailDemand& demand, double physical_cost);
  /// A tree that is to get modes.
  struct Candidate {
    Plant* plant{nullptr};
    bool fine{false};
  };
  /// The candidates with the largest errors, and that of the request.
  struct Candidates {
    Candidate plain, finer, large, requested;
  };
  Candidates findCandidates(const PredictionContext& context, const Start& start,
                            const TreeDetail& detail);
  void startModes(const PredictionContext& context, const Start& start, TreeDetail& detail);
  bool startRequested(const ModalContext& at, const Start& start, const Candidates& candidates,
                      const PredictionContext& context, TreeDetail& detail);
  void start(const ModalContext& at, const Candidate& candidate, Nanoseconds stamp,
             const ModalTreeState* like, TreeDetail& detail) const;
  /// A tree that is to change its level, and how much error that saves.
  struct Change {
    std::uint32_t tree;
    int level;
    double saved;
  };
  std::vector<Change> listChanges(const TreeDetail& detail) const;
  void setLevels(const PredictionContext& context, std::size_t most, TreeDetail& detail) const;

  std::vector<Plant> plants_;
  GovernorFigures figures_;
  bool has_computed_{false};
  std::set<ModesWorker::Key> awaited_;
};

}  // namespace vegetation_sim::forest
