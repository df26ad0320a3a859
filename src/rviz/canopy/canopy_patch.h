// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <optional>
#include <string>
#include <vector>

#include "ros/replicas/leafed_crowns.h"
#include "rviz/render/batch.h"
#include "rviz/textures/foliage_texture.h"
#include "rviz/textures/sky_texture.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::view {

/// Neighbouring plants, or a crown of the forest, in two batches of leaves and stems. The outer
/// leaves of each plant come first because they hide the others. Fewer, larger leaves are drawn at
/// a distance. Render thread only.
class CanopyPatch {
 public:
  /// @param plants ids in the layout. @param node with its frame at `origin` [m].
  CanopyPatch(const canopy::Replica& canopy, const std::vector<std::size_t>& plants,
              const Vec3& origin, Ogre::SceneNode& node, const std::string& leaf_material,
              const std::string& stem_material, const Vec3& to_sun);
  /// Builds the leaves of a crown without its wood. @param number of the crown.
  CanopyPatch(const canopy::Layout& layout, const LeafedCrowns::Crown& crown, std::size_t number,
              const Vec3& origin, Ogre::SceneNode& node, const std::string& leaf_material,
              const std::string& stem_material, const Vec3& to_sun);

  /// Number of the crown; without a value for plants.
  const std::optional<std::size_t>& crown() const { return crown_; }
  std::size_t leafCount() const { return leaves_.size(); }
  const std::vector<std::size_t>& plants() const { return plants_; }
  /// Returns whether plants have been cut, or restored, since the patch was made.
  bool isOutdated(const canopy::Replica& canopy) const;
  const Vec3& middle() const { return middle_; }
  double reach() const { return reach_; }         ///< [m] radius around the middle
  double tallest() const { return tallest_; }     ///< [m] height of the tallest plant
  double leafSize() const { return leaf_size_; }  ///< [m] mean length
  bool takeSeen() { return leaf_batch_.takeSeen(); }
  void setRank(int rank);

  /// Moves and draws the first `count` leaves, wider if they are not all.
  void move(const canopy::Foliage& foliage, std::size_t count);
  /// Moves the leaves of a crown whose branches have their bases at `wood`.
  void move(const canopy::Foliage& foliage, const LeafedCrowns::Crown& crown,
            const std::vector<Pose>& wood, std::size_t count);
  std::size_t drawn() const { return drawn_; }
  /// Calls `drop(place, radius, depth)` for leaves that cast a shadow.
  template <class Drop>
  void setShadows(const Drop& drop) const {
    for (std::size_t i = 0; i < leaves_.size(); i += 2)
      drop(leaves_[i].leaf.tip, 0.6 * length(leaves_[i].leaf.tip - leaves_[i].leaf.root), 0.8);
  }

 private:
  struct Drawn {
    canopy::Leaf leaf;
    std::size_t owner;  // plant, or number in the crown
    std::size_t kind;
    Vec3 in_ball;  // place in the unit ball of leaves
    LeafCut cut;
    float order;  // leaves are drawn in rising order
  };
  void grow(const canopy::Layout& layout, std::size_t plant, double height);
  void finish(const canopy::Layout& layout, Ogre::SceneNode& node, const Vec3& to_sun);
  template <class Mover>
  void moveBy(const Mover& mover, std::size_t count);
  void bendStems(const canopy::Foliage& foliage);
  void addStems(const canopy::GrownPlant& grown, const Vec3& colour);
  void addRigid(const canopy::GrownPlant& grown, const Vec3& colour);
  VertexPaint paintOf(const canopy::Layout& layout, const Drawn& drawn, const Vec3& to_sun) const;
  void build(const canopy::Layout& layout, const Vec3& to_sun);

  std::optional<std::size_t> crown_;
  std::vector<std::size_t> plants_;
  std::vector<double> heights_;  // at which the plants have been cut [m]
  Vec3 origin_, middle_{Vec3::Zero()};
  double reach_{0.0}, leaf_size_{0.1}, tallest_{0.0};
  std::vector<Drawn> leaves_;
  std::vector<float> positions_;
  std::vector<float> stem_positions_;
  std::vector<VertexPaint> stem_paint_;
  std::vector<std::size_t> stem_owners_;  // plants of the vertices
  std::vector<std::uint32_t> stem_triangles_;
  Batch leaf_batch_, stem_batch_;
  std::size_t drawn_{0};
  bool bent_{false};  // bodies had pushed stems when they were drawn last
};

}  // namespace vegetation_sim::view
