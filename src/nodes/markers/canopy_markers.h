// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/lod/tier_hysteresis.h"
#include "nodes/markers/marker_publisher.h"
#include "ros/replicas/leafed_crowns.h"
#include "ros/services/allocation_report.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim {

/// Builds the marker lists of a canopy: leaves (id 0), rigid stems (id 1), shade on the ground
/// (id 2) and, if the layout has crowns, their leaves (id 3). Each plant has the smallest share of
/// its leaves that holds the tolerance, with wider leaves the fewer there are. If the budget does
/// not suffice, points go to the plants whose error each point reduces most. All crowns have the
/// same share.
class CanopyMarkers : public MarkerBuilder {
 public:
  /// @param forest has the trees of the crowns. @param points of all lists together, at least 600.
  /// @param tolerance [pixel]
  CanopyMarkers(canopy::Canopy& canopy, const LeafedCrowns& crowns,
                const forest::ForestReplica& forest, int points, double tolerance);

  /// Without viewers, all plants are out of sight.
  void build(const std::vector<Viewpoint>& viewers, Nanoseconds stamp) override;
  /// Takes the leaves of the crowns, which have changed.
  void updateCrowns();
  /// The tiers chosen at the last build, with costs in points.
  const TierAllocation& balance() const { return balance_; }
  /// The part of the budget that is for leaves of plants [points].
  std::size_t room() const { return lists_.size(LEAVES); }
  void reportTiers(diagnostic_updater::DiagnosticStatusWrapper& status) const {
    report(balance(), balanceTerms(), status);
  }
  /// Names and limits of the last choice, balance().
  BalanceTerms balanceTerms() const;

 private:
  struct Drawn {
    canopy::Leaf leaf;
    std_msgs::ColorRGBA colour;
  };
  struct DrawnPlant {
    int tier{0};
    double height{canopy::UNCUT};  // of the cut [m]
    std::vector<Drawn> leaves;
  };
  /// Parts of a plant that wind does not move, at rest.
  struct Wood {
    std::vector<canopy::Stem> stems;
    std::vector<canopy::Leaf> faces;
  };
  /// Errors and costs of the tiers of a plant of scale 1.
  struct Ladder {
    std::array<float, MAX_TIERS> gaps{}, points{};  ///< [m], leaves only
  };
  void shareLeaves();
  void setLadders();
  void addWood(std::size_t id);
  Wood woodOf(std::size_t id) const;
  void bendWood(bool cut);
  bool updateCuts();
  void addShades();
  /// Returns how many leaves of a crown are drawn. They are its first ones.
  std::size_t drawnOf(std::size_t leaves) const;
  void choose(const std::vector<Viewpoint>& viewers, Nanoseconds stamp);
  DrawnPlant drawPlant(std::size_t id, int tier) const;
  void addLeaf(std::size_t list, const Drawn& drawn, const canopy::MovedLeaf& moved);
  void addCrowns(const canopy::Foliage& foliage, Nanoseconds stamp);
  void addShade(const canopy::Plant& plant, double radius);
  void addStem(const canopy::Stem& stem, const Vec3& colour);

  enum List : std::size_t { LEAVES, STEMS, SHADE, CROWNS };
  canopy::Canopy& canopy_;
  const canopy::Layout& layout_;
  const LeafedCrowns& crowns_;
  const forest::ForestReplica& forest_;
  double tolerance_;
  std::size_t leaf_points_;          // of plants and crowns
  double share_{1.0};                // of a crown's leaves
  std::vector<double> shares_;       // of a plant's leaves, by tier
  std::vector<Ladder> ladders_;      // by kind
  std::vector<TierChoice> choices_;  // as the layout has its plants
  std::vector<DrawnPlant> plants_;
  std::vector<Wood> wood_;  // of the plants
  std::vector<Drawn> crown_leaves_;
  bool bent_{false};  // bodies had pushed plants at the last build
  TierHysteresis held_;
  TierAllocation balance_;
};

}  // namespace vegetation_sim
