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

/// Leaves (id 0), rigid stems (id 1), the shade on the ground (id 2) and leaves of the forest's
/// crowns, if the layout asks for any (id 3), as TRIANGLE_LISTs of constant size, which rviz
/// updates in place. Each plant has the smallest share of its leaves that holds the tolerance,
/// made wider as they are fewer; where the points do not suffice, they go to the plants whose error
/// each point lessens most (N7). Crowns have an even part of theirs. Degenerate triangles fill
/// up, and a list of nothing is deleted.
class CanopyMarkers {
 public:
  /// @param points of all lists together, at least 600.
  explicit CanopyMarkers(int points);

  /// Grows what of the plants of a layout never moves.
  void setLayout(const canopy::Layout& layout);
  /// Leaves of the forest's crowns that the same layout asks for.
  void setCrowns(const canopy::Layout& layout, const LeafedCrowns& crowns);
  /// How many of a crown's leaves are drawn: the first ones.
  std::size_t drawnOf(std::size_t leaves) const;
  /// Chooses what is drawn of each plant of the layout that was set. @param tolerance [pixel]
  void choose(const canopy::Layout& layout, const Viewpoint& eye, double tolerance,
              Nanoseconds stamp);
  /// The leaves where `foliage` carries them, and those of the crowns, crown by crown the drawn
  /// ones, where they are.
  visualization_msgs::MarkerArray build(const canopy::Foliage& foliage,
                                        const std::vector<canopy::MovedLeaf>& crowns,
                                        const std::string& frame_id);
  /// What was chosen for plants [points], and the names of the tiers.
  const TierAllocation& balance() const { return balance_; }
  std::vector<std::string> tiers() const;
  /// Points in use at the last build.
  std::size_t points() const { return lists_.used(); }
  std::size_t budget() const { return leaf_points_ + lists_.size(STEMS) + lists_.size(SHADE); }
  /// Of these, points that leaves of plants share.
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
  /// Of plants of scale 1, by tier.
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
