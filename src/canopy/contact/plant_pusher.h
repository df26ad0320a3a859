// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "canopy/contact/cluster_step.h"

namespace vegetation_sim::canopy {

/// Moves the plants of a layout among bodies. Plants that stand upright and have no body near cost
/// nothing.
class PlantPusher {
 public:
  /// The kinds and plants must outlive it.
  PlantPusher(const std::vector<PlantKind>& kinds, const std::vector<Plant>& plants)
      : kinds_(kinds), plants_(plants) {}

  /// Advances between two ticks. Returns the forces on bodies, by plant and then by body.
  std::vector<PushForce> advance(PushState& state, Nanoseconds from, Nanoseconds to);
  /// Returns whether a body may touch a plant soon.
  bool isNear(const PushState& state, const forest::Body& body, Nanoseconds now);
  /// Number of times that a plant did not lean because too many cells do.
  std::uint64_t refused() const { return refused_; }

  Fibres fibresOf(std::uint32_t plant, double height = UNCUT) const {
    return canopy::fibresOf(kinds_[plants_[plant].kind], plants_[plant], height);
  }
  const PushLaw& lawOf(std::uint32_t plant) const { return kinds_[plants_[plant].kind].push; }

 private:
  using Near = std::vector<const forest::Body*>;
  using Square = std::pair<int, int>;

  void sortPlants();
  template <class Visit>
  void visitNear(const PushState& state, const forest::Body& body, Nanoseconds from, Nanoseconds to,
                 Visit visit) const;
  std::map<std::uint32_t, Near> findTouched(const PushState& state, Nanoseconds from,
                                            Nanoseconds to) const;
  bool canReach(std::uint32_t plant, const PushState& state, const forest::Body& body,
                Nanoseconds from, Nanoseconds to) const;
  void step(std::uint32_t plant, const Fibres& fibres, const Near& near, Nanoseconds from,
            Nanoseconds to, std::vector<Cluster>& clusters, std::vector<PushForce>& out) const;

  const std::vector<PlantKind>& kinds_;
  const std::vector<Plant>& plants_;
  std::map<Square, std::vector<std::uint32_t>> squares_;  // of ground, with the plants on them
  double largest_{0.0};                                   // reach of a plant that leans [m]
  bool sorted_{false};
  std::uint64_t refused_{0};
};

}  // namespace vegetation_sim::canopy
