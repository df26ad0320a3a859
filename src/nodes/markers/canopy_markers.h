// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/lod/tier_hysteresis.h"
#include "nodes/markers/triangle_lists.h"
#include "ros/replicas/leafed_crowns.h"
#include "vegetation_sim/canopy/leaf_motion.h"
#include "vegetation_sim/core/lod/viewpoint.h"

namespace vegetation_sim {

/// Builds the marker lists of a canopy: leaves (id 0), rigid stems (id 1), shade on the ground
/// (id 2) and, if the layout has crowns, their leaves (id 3). Each plant has the smallest share of
/// its leaves that holds the tolerance, with wider leaves the fewer there are. If the budget does
/// not suffice, points go to the plants whose error each point reduces most. All crowns have the
/// same share.
class CanopyMarkers {
 public:
  /// @param points of all lists together, at least 600.
  explicit CanopyMarkers(int points);

  /// Builds the parts of the plants that never move.
  void setLayout(const canopy::Layout& layout);
  /// Sets the leaves of the crowns of the same layout.
  void setCrowns(const canopy::Layout& layout, const LeafedCrowns& crowns);
  /// Returns how many leaves of a crown are drawn. They are its first ones.
  std::size_t drawnOf(std::size_t leaves) const;
  /// Chooses the tier of each plant. Requires the layout of setLayout(). @param tolerance [pixel]
  void choose(const canopy::Layout& layout, const Viewpoint& eye, double tolerance,
              Nanoseconds stamp);
  /// Builds the array with the leaves as `foliage` moves them.
  /// @param crowns places of the drawn leaves of all crowns, crown by crown.
  visualization_msgs::MarkerArray build(const canopy::Foliage& foliage,
                                        const std::vector<canopy::MovedLeaf>& crowns,
                                        const std::string& frame_id);
  /// The tiers chosen last, with costs in points, and their names.
  const TierAllocation& balance() const { return balance_; }
  std::vector<std::string> tiers() const;
  /// Points in use at the last build.
  std::size_t points() const { return lists_.used(); }
  std::size_t budget() const { return leaf_points_ + lists_.size(STEMS) + lists_.size(SHADE); }
  /// The part of the budget that is for leaves of plants [points].
  std::size_t room() const { return lists_.size(LEAVES); }

 private:
  struct Drawn {
    canopy::Leaf leaf;
    std_msgs::ColorRGBA colour;
  };
  struct DrawnPlant {
    int tier{0};
    std::vector<Drawn> leaves;
  };
  /// Errors and costs of the tiers of a plant of scale 1.
  struct Ladder {
    std::array<float, MAX_TIERS> gaps{}, points{};  ///< [m], leaves only
  };
  void setLadders(const canopy::Layout& layout);
  void addPlant(const canopy::Layout& layout, std::size_t id);
  DrawnPlant drawPlant(const canopy::Layout& layout, std::size_t id, int tier) const;
  void addShade(const canopy::Plant& plant, double radius);
  void addStems(const std::vector<canopy::Stem>& stems, const Vec3& colour);

  enum List : std::size_t { LEAVES, STEMS, SHADE, CROWNS };
  std::size_t leaf_points_;  // of plants and crowns
  TriangleLists lists_;
  double share_{1.0};                // of a crown's leaves
  std::vector<double> shares_;       // of a plant's leaves, by tier
  std::vector<Ladder> ladders_;      // by kind
  std::vector<TierChoice> choices_;  // as the layout has its plants
  std::vector<DrawnPlant> plants_;
  std::vector<Drawn> crown_leaves_;
  TierHysteresis held_;
  TierAllocation balance_;
};

}  // namespace vegetation_sim
