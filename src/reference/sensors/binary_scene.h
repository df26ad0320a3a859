// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "reference/sensors/box_tree.h"
#include "sensors/sensor_scene.h"

namespace vegetation_sim::scan {

/// Trees and people of a scene in binary hierarchies of boxes in double precision, to which Trees
/// and People are compared. The scene must outlive it and not change.
class BinaryScene {
 public:
  explicit BinaryScene(const Scene& scene);

  /// Returns the same as cast().
  Hit cast(const Ray& ray, double reach) const;
  /// Does the same as Trees::meet().
  void meetTrees(const Ray& ray, Hit& nearest) const;

 private:
  const Scene& scene_;
  std::vector<BoxTree> branches_;  ///< of each tree
  BoxTree trees_, limbs_;
};

}  // namespace vegetation_sim::scan
