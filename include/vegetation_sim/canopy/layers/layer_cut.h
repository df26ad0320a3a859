// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/canopy/layers/layers.h"

namespace vegetation_sim::canopy {

/// How the depth of the vegetation is cut into layers (S3-05), and when it is cut anew (S3-04).
struct CutSettings {
  int near_layers{3};      ///< up to near_end
  int mid_layers{1};       ///< from there to mid_end
  int far_layers{1};       ///< beyond
  double near_end{10.0};   ///< distance from the eye [m]
  double mid_end{25.0};    ///< [m]
  double turn{0.1};        ///< of the view before layers are cut anew [rad]
  double shift{0.3};       ///< of the eye before that, in thicknesses of a layer
  double cross_fade{0.7};  ///< from old layers to new ones [s]
};
void describe(FieldVisitor& visitor, CutSettings& settings);
/// Faults of the fields, of regions out of order and of no layer at all.
void check(CutSettings settings, const std::string& context, Faults& faults);

/// An eye that the layers are cut for.
struct CutView {
  Vec3 position{Vec3::Zero()};  ///< [m], world
  Quat orientation;             ///< looks along x, z up
};

/// Layers parallel to the picture of one view. Depth counts along the way the eye looks.
class LayerCut {
 public:
  /// One layer for everything.
  LayerCut() = default;
  /// @param nearest, farthest depths of what is to be cut [m]; regions without any are left out. An
  /// eye within the vegetation has layers from itself on, and what is behind it in the first.
  LayerCut(const CutView& view, const CutSettings& settings, double nearest, double farthest);

  int layers() const { return static_cast<int>(distances_.size()); }
  double depthOf(const Vec3& world) const { return -dot(axes_.out, Vec3(world - eye_)); }
  /// Layer of a leaf by the place of its root (S3-03).
  int layerAt(const Vec3& root) const;
  /// Of the middle of a layer from that of the first [m].
  double distance(int layer) const { return distances_[static_cast<std::size_t>(layer)]; }
  double last() const { return distances_.back(); }
  /// Depth of the middle of a layer [m].
  double middle(int layer) const { return first_ + distance(layer); }
  const Axes& axes() const { return axes_; }
  /// True if layers cut for `view` would differ enough from these to cut anew.
  bool leftBy(const CutView& view, const CutSettings& settings) const;

 private:
  Vec3 eye_{Vec3::Zero()};
  Axes axes_;
  std::vector<double> ends_;            // depth where each layer but the last ends
  std::vector<double> distances_{0.0};  // of the middles
  double first_{0.0};                   // depth of the first middle
  double thickness_{1.0};               // of the thinnest layer; of nothing, a metre
};

}  // namespace vegetation_sim::canopy
