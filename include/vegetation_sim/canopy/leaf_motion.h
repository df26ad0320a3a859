// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "vegetation_sim/canopy/canopy_layout.h"
#include "vegetation_sim/canopy/contact/fibres.h"
#include "vegetation_sim/canopy/layers/motion_history.h"
#include "vegetation_sim/core/math/time.h"

namespace vegetation_sim::canopy {

/// Views that the layers are cut for, and the transition between them (S3-04).
struct CutState {
  CutView now, before;
  Nanoseconds since{0};  ///< start of the cross-fade
};

/// Returns the share of the newer of the two cuts at a stamp, 0 to 1.
double cutShare(const CutState& state, const CutSettings& settings, Nanoseconds stamp);

/// Box around leaves at rest.
struct LeafBox {
  Vec3 low{Vec3::Zero()}, high{Vec3::Zero()};  ///< [m], world
};

/// How freely a point of a plant moves.
struct Freedom {
  double share{0.0};  ///< R of equation 7, 0 to 1
  double limit{0.0};  ///< limit of its displacement for a share of 1 [m]
};

/// Position of a leaf that has moved.
struct MovedLeaf {
  Vec3 root, tip, side;  ///< [m], world
};

/// The layers of the whole foliage at one tick, from the animator's state or from its messages,
/// with the same bits. The cost depends on cells and layers, not on leaves (S3-28).
class Foliage {
 public:
  explicit Foliage(const Layout& layout);

  /// Sets crowns of the forest that hang in the layers, too (S3-W2), from the next update on.
  void setCrowns(std::vector<LeafBox> crowns) { crowns_ = std::move(crowns); }
  /// @param history has the size of the layout. @param front_share see Driver::share().
  void update(const History& history, double front_share, const CutState& cuts, Nanoseconds stamp);

  /// Sets the cells that bodies have pushed; all others stand upright.
  void setBent(const std::vector<BentCell>& cells);
  /// @throws InvalidInput for cells that the layout does not have, in another order or with larger
  /// leans than fibres can have.
  void checkBent(const std::vector<BentCell>& cells) const;

  /// Sets the heights at which plants have been cut; they must outlive it.
  void setStubble(const Stubble& stubble) { stubble_ = &stubble; }
  /// Returns the height at which a plant has been cut, or UNCUT [m].
  double cutHeight(std::size_t plant) const;
  /// Returns whether a plant has been cut.
  bool anyCut() const { return stubble_ && !stubble_->empty(); }

  /// Cuts all plants and crowns into layers for a view.
  LayerCut cutFor(const CutView& view) const { return cut(view, true); }
  /// Cuts the plants alone, which follow from the layout: the state must not depend on crowns.
  LayerCut cutOfPlants(const CutView& view) const { return cut(view, false); }
  /// Returns whether bodies have pushed a plant.
  bool isBent(std::size_t plant) const { return bent_.count(plant) > 0; }
  bool anyBent() const { return !bent_.empty(); }
  /// Returns where a rigid point of a plant is that wind does not move, such as the end of a stem.
  Vec3 bend(const Vec3& point, std::size_t plant) const;
  /// Returns the displacement [m], world, of a point at rest whose leaf hangs at `anchor`: with its
  /// layer, and with the fibre on which the anchor is. @param plant id, whose foot and height
  /// determine how freely it moves.
  Vec3 displacement(const Vec3& anchor, const Vec3& point, std::size_t plant) const;
  /// Returns how freely a point at rest moves, from the foot and the height of its plant.
  Freedom freedomOf(const Vec3& point, std::size_t plant) const;
  /// Returns the same for a leaf that is on no plant of the layout, limited to about `limit` [m].
  Vec3 freeDisplacement(const Vec3& anchor, const Vec3& point, double limit) const;
  MovedLeaf move(const Leaf& leaf, std::size_t plant) const;
  /// Returns the velocity [m/s] of the layer of `anchor` at a point, in the view's axes: right, up,
  /// towards the viewer.
  Vec3 motion(const Vec3& anchor, const Vec3& point) const;
  /// Returns the velocity of a whole layer in single precision, for checks and hashes: [cells x
  /// cells x 3] right, up, towards the viewer, row after row from the lowest [m/s].
  std::vector<float> sheet(int layer) const;
  int layerAt(const Vec3& anchor) const { return cuts_[0].cut.layerAt(anchor); }
  int layers() const { return cuts_[0].cut.layers(); }
  const LayerCut& layerCut() const { return cuts_[0].cut; }
  /// Returns the stamp at which the layers were cut.
  Nanoseconds cutSince() const { return cut_since_; }
  const WarpSettings& warp() const { return layout_.motion.warp; }

 private:
  struct Cut {
    LayerCut cut;
    PlaneToView to_view;
    std::vector<LayerMotion> layers;
    std::vector<double> shares;  // depthShare() of each layer
  };
  /// Rotation of a fibre about its foot.
  struct Turn {
    Vec3 foot;
    Quat turn;
    Vec3 of(const Vec3& point) const { return foot + rotate(turn, Vec3(point - foot)); }
  };
  struct BentPlant {
    Fibres fibres;
    std::vector<Flat> leans;  // of the cells
  };
  static Turn turnAt(const BentPlant& plant, const Vec3& anchor);
  Vec3 sway(const Vec3& anchor, const Vec3& point, std::size_t plant) const;
  MovedLeaf swayed(const Leaf& leaf, std::size_t plant) const;
  LayerCut cut(const CutView& view, bool crowns) const;
  void build(Cut& cut, const CutView& view, const History& history, double front_share);
  Vec3 motionIn(const Cut& cut, const Vec3& anchor, const Vec3& point) const;
  Vec3 displacementIn(const Cut& cut, const Vec3& anchor, const Vec3& point, double limit) const;

  const Layout& layout_;
  Plane plane_;
  std::vector<double> tops_;  // height of each plant [m]
  std::vector<LeafBox> crowns_;
  std::array<Cut, 2> cuts_;  // cuts, the newer one first
  double share_{1.0};        // share of the newer one
  Nanoseconds cut_since_{0};
  std::map<std::size_t, BentPlant> bent_;
  const Stubble* stubble_{nullptr};
};

}  // namespace vegetation_sim::canopy
