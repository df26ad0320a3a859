// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "vegetation_sim/forest/physics/modal_forest.h"

namespace vegetation_sim::forest {

/// Computes the modes of trees on other threads. Modes follow from layout, terrain and broken
/// branches alone, so that results do not depend on when they were begun. A value: copies share
/// results. Not thread-safe.
class ModesWorker {
 public:
  /// A tree, and whether its fine modes are meant.
  using Key = std::pair<std::uint32_t, bool>;

  /// Begins the computation unless it has begun.
  void begin(const ModalContext& at, const Key& key);
  /// Returns a tree at rest with these modes, and nullptr if they have not been begun. Waits until
  /// they are computed. @throws what the computation threw.
  const ModalTreeState* find(const ModalContext& at, const Key& key);
  /// Returns whether nothing is being computed.
  bool isIdle() const;
  /// Forgets all computations but these.
  void retain(const std::set<Key>& keys);
  /// Forgets all computations, because layout or terrain change.
  void clear() { retain({}); }

 private:
  using Result = std::shared_future<std::shared_ptr<const ModalTreeState>>;
  struct Computation {
    BrokenBranches broken;
    Result result;
  };
  std::map<Key, Computation> computations_;
  std::vector<Result> forgotten_;  ///< Their ends are not waited for.
};

}  // namespace vegetation_sim::forest
