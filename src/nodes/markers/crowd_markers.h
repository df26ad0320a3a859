// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/lod/tier_hysteresis.h"
#include "crowd/agents/crowd.h"
#include "crowd/body/motion_style.h"
#include "nodes/markers/marker_publisher.h"
#include "ros/services/allocation_report.h"

namespace vegetation_sim {

/// Builds the marker list of a crowd, with fifteen limbs for each walker. Each has the fewest
/// facets that hold the tolerance. If the budget does not suffice, points go to the walkers whose
/// error each point reduces most.
class CrowdMarkers : public MarkerBuilder {
 public:
  /// @param points of the list. @param tolerance [pixel] @param shard whose people are drawn.
  CrowdMarkers(const crowd::Crowd& crowd, int points, double tolerance,
               const crowd::MotionStyles& styles, const Shard& shard = {});

  /// Without viewers, all walkers have the same size in the picture.
  void build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) override;
  /// The tiers chosen at the last build, with costs in points.
  const TierAllocation& balance() const { return balance_; }
  void reportTiers(diagnostic_updater::DiagnosticStatusWrapper& status) const {
    report(balance(), balanceTerms(), status);
  }
  /// Names and limits of the last choice, balance().
  BalanceTerms balanceTerms() const;

 private:
  void choose(const std::vector<Viewpoint>& viewers, Nanoseconds stamp);
  void addPerson(const crowd::Walker& walker, int sides);

  const crowd::Crowd& crowd_;
  double tolerance_;
  crowd::MotionStyles styles_;
  std::vector<TierChoice> choices_;  // as the crowd has its walkers
  TierHysteresis held_;
  TierAllocation balance_;
};

}  // namespace vegetation_sim
