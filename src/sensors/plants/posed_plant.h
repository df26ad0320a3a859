// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sensors/geometry/ranked_hit.h"
#include "sensors/plants/plant_masks.h"
#include "sensors/traversal/rod_tree.h"
#include "sensors/traversal/strip_tree.h"
#include "vegetation_sim/canopy/leaf_motion.h"

namespace vegetation_sim::scan {

/// One leafy plant of a canopy for rays: a strip per leaf, piece of a ribbon or face, of which the
/// leaves move, and a rod per stem. Where bodies push the plant, all parts move. Rays pass where
/// the texture of a face is transparent.
class PosedPlant {
 public:
  /// Grows the plant. @param height at which it has been cut [m]. @param masks of its kind; null:
  /// all faces are opaque.
  PosedPlant(const canopy::Layout& layout, std::uint32_t id, double height = canopy::UNCUT,
             std::shared_ptr<const KindMasks> masks = {});

  /// Moves all leaves with their layers, and all parts with their fibres.
  void pose(const canopy::Foliage& foliage);

  std::uint32_t id() const { return id_; }
  double cutHeight() const { return cut_height_; }
  /// Colours of the kind of the plant in sRGB.
  struct Paint {
    Vec3 leaf, young, stem;
  };
  const Paint& paint() const { return paint_; }
  const std::vector<canopy::Leaf>& leaves() const { return leaves_; }
  /// Number of strips and stems.
  std::size_t parts() const { return strips_.size() + stems_.size(); }
  Box bounds() const;
  /// Leaves first, then rigid faces.
  const std::vector<Strip>& strips() const { return strips_; }
  const std::vector<Rod>& stems() const { return stems_; }

  /// Replaces the hit by a nearer one on this plant. Parts have the ranks from `first_rank` on.
  void meet(const Ray& ray, const FloatRay& narrow, std::uint64_t first_rank,
            RankedHit& nearest) const;
  /// Does the same without ranks for one strip or stem; returns whether there is a nearer hit.
  bool meetStrip(std::size_t strip, const Ray& ray, Hit& nearest) const;
  bool meetStem(std::size_t stem, const Ray& ray, Hit& nearest) const;

 private:
  void bendWood(const canopy::Foliage& foliage);
  bool isHole(std::size_t strip, const Vec3& place) const;

  std::uint32_t id_;
  double cut_height_;
  Vec3 foot_;  ///< world [m]
  Paint paint_;
  std::shared_ptr<const KindMasks> masks_;    ///< null: all faces are opaque
  std::vector<canopy::Leaf> leaves_, rigid_;  ///< at rest
  std::vector<canopy::Stem> grown_stems_;     ///< at rest
  std::vector<Strip> strips_;                 ///< of leaves_, then of rigid faces
  std::vector<Rod> stems_;
  StripTree strip_tree_;
  RodTree stem_tree_;
  bool bent_{false};  ///< bodies had pushed the plant when it was posed last
};

}  // namespace vegetation_sim::scan
