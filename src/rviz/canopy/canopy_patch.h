// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreSceneNode.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros/replicas/leafed_crowns.h"
#include "rviz/canopy/plant_textures.h"
#include "rviz/canopy/stalk_strips.h"
#include "rviz/render/batch.h"
#include "rviz/textures/foliage_texture.h"
#include "rviz/textures/sky_texture.h"
#include "rviz/trees/shared_light.h"
#include "vegetation_sim/canopy/canopy.h"

namespace vegetation_sim::view {

/// Where a patch is drawn, and how it looks.
struct PatchScene {
  Vec3 origin;            ///< of the frame of `node` [m]
  Ogre::SceneNode* node;  ///< lives longer than the patch
  std::string leaf_material, stem_material;
  Vec3 to_sun;
  const PlantTextures* textures;
  std::string frame;  ///< of the layout
};

/// Neighbouring plants, or a crown of the forest, in two batches of leaves and stems. The outer
/// leaves of each plant come first because they hide the others. Fewer, larger leaves are drawn at
/// a distance. Render thread only.
class CanopyPatch {
 public:
  /// @param plants ids in the layout. @param heights at which they have been cut, or UNCUT [m].
  CanopyPatch(const canopy::Layout& layout, std::vector<std::size_t> plants,
              std::vector<double> heights, const PatchScene& scene);
  /// Builds the leaves of a crown without its wood. @param number of the crown.
  CanopyPatch(const canopy::Layout& layout, const LeafedCrowns::Crown& crown, std::size_t number,
              const PatchScene& scene);

  /// Number of the crown; without a value for plants.
  const std::optional<std::size_t>& crown() const { return crown_; }
  std::size_t leafCount() const { return leaves_.size(); }
  const std::vector<std::size_t>& plants() const { return plants_; }
  /// Returns whether plants have been cut, or restored, since the patch was made.
  bool isOutdated(const canopy::Replica& canopy) const;
  /// Returns whether trees that other displays show give plants another light than when the patch
  /// was made.
  bool isInOtherLight() const;
  const Vec3& middle() const { return middle_; }
  double reach() const { return reach_; }         ///< [m] radius around the middle
  double tallest() const { return tallest_; }     ///< [m] height of the tallest plant
  double leafSize() const { return leaf_size_; }  ///< [m] mean length
  bool takeSeen() { return leaf_batch_.takeSeen(); }
  void setRank(int rank);

  /// Moves and draws the first `count` leaves, wider if they are not all, without those in layers
  /// that `pictured` selects.
  void move(const canopy::Foliage& foliage, std::size_t count, const std::vector<bool>& pictured);
  /// Returns whether all leaves are in layers that `pictured` selects.
  bool isPictured(const canopy::Foliage& foliage, const std::vector<bool>& pictured) const;
  /// Returns whether bodies have pushed a plant.
  bool isBent(const canopy::Foliage& foliage) const;
  /// Leaves of whole plants in full light that are read from a file, since all of their kind are
  /// alike, or of the others.
  enum class Share { ALIKE, OTHERS };
  /// Returns such plants, which have leaves.
  std::vector<std::size_t> alike() const;
  /// Returns a share of the leaves at rest, on a node of another scene with its frame at the
  /// origin. Those that are alike are in random order.
  std::unique_ptr<Batch> copyAtRest(Ogre::SceneNode& node, const std::string& material,
                                    Share share) const;
  /// Calls visit(leaf, plant) for every `stride`-th leaf of a share, and for each piece of stalks.
  template <class Visit>
  void eachLeaf(Share share, std::size_t stride, const Visit& visit) const {
    std::size_t number = 0;
    for (const Drawn& drawn : leaves_)
      if (drawn.share == share && (number++ % stride == 0 || drawn.face == 0))
        visit(drawn.leaf, drawn.owner);
  }
  std::size_t leafCount(Share share) const {
    return share == Share::ALIKE ? alike_ : leaves_.size() - alike_;
  }
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
    Share share;
    float order;    // leaves are drawn in rising order
    int strip{-1};  // index in strips_ while the patch is built; -1: painted as its kind
    std::array<Roll, 2> roll{};
    int face{-1};  // of a stalk
  };
  void grow(const canopy::Layout& layout, std::size_t plant, double height);
  void addStrips(const canopy::GrownPlant& grown, const canopy::Layout& layout, std::size_t plant,
                 double height);
  void finish(const canopy::Layout& layout, const PatchScene& scene);
  float* placeCorners(const canopy::MovedLeaf& moved, const Drawn& drawn, double grown,
                      float* out) const;
  template <class Mover>
  void moveBy(const Mover& mover, std::size_t count);
  void bendStems(const canopy::Foliage& foliage);
  void addStems(const canopy::GrownPlant& grown, const Vec3& colour);
  void addRigid(const canopy::GrownPlant& grown, const canopy::PlantKind& kind, std::size_t number);
  SharedLight::Shares lightAt(const Vec3& place) const;
  std::array<float, 2> placeOf(const canopy::Layout& layout, const Drawn& drawn, int corner) const;
  VertexPaint paintOf(const canopy::Layout& layout, const Drawn& drawn, const Vec3& to_sun) const;
  VertexPaint ownPaintOf(const canopy::Layout& layout, const Drawn& drawn,
                         const Vec3& to_sun) const;
  void paintEnds(const StripPaint& strip, const SharedLight::Shares& around,
                 VertexPaint* corners) const;
  void build(const canopy::Layout& layout, const Vec3& to_sun);
  std::vector<float> placeAtRest(const std::vector<const Drawn*>& leaves) const;

  std::optional<std::size_t> crown_;
  std::vector<std::size_t> plants_;
  std::vector<double> heights_;             // at which the plants have been cut [m]
  std::vector<Vec3> tops_;                  // of the plants
  std::vector<SharedLight::Shares> light_;  // at the tops when the patch was made
  const PlantTextures* textures_;
  const Ogre::SceneManager* scene_;
  std::string frame_;
  Vec3 origin_, middle_{Vec3::Zero()};
  double reach_{0.0}, leaf_size_{0.1}, tallest_{0.0};
  std::vector<Drawn> leaves_;
  std::size_t alike_{0};  // leaves of Share::ALIKE
  std::vector<StripPaint> strips_;
  std::vector<VertexPaint> leaf_paint_;
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
