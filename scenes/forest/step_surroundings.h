// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "forest/forest.h"

namespace vegetation_sim::forest {

/// What the steps of single trees need besides their forest, without bodies.
class StepSurroundings {
 public:
  /// Returns the context of steps from a stamp on, as a forest gives it to its physics. It refers
  /// to the forest and to this.
  StepContext at(const Forest& forest, Nanoseconds stamp) const {
    return {forest.layout(),
            forest.layoutHash(),
            forest.terrain(),
            forest.snapshot().wind,
            forest.world().levels,
            forest.world().modes,
            contacts_,
            forest.grid(),
            threads_,
            forest.owners(),
            false,
            stamp};
  }

 private:
  ContactFinder contacts_;
  mutable ThreadPool threads_;
};

}  // namespace vegetation_sim::forest
