// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "vegetation_sim/canopy/layers/layer_delay.h"

namespace vegetation_sim::canopy {

/// Settings of the layers that the depth of the vegetation is cut into (S3-05), and of when it is
/// cut again (S3-04).
struct CutSettings {
  int near_layers{3};     ///< layers up to near_end
  int mid_layers{1};      ///< layers from near_end to mid_end
  int far_layers{1};      ///< layers beyond mid_end
  double near_end{10.0};  ///< distance from the viewer [m]
  double mid_end{25.0};   ///< [m]
  double turn{0.1};       ///< turn of the view after which layers are cut again [rad]
  /// shift of the viewer after which layers are cut again, in thicknesses of a layer
  double shift{0.3};
  double cross_fade{0.7};  ///< transition from old layers to new ones [s]
};
void describe(FieldVisitor& visitor, CutSettings& settings);
/// Adds the faults of the fields, of regions out of order and of settings without layers.
void check(CutSettings settings, const std::string& context, Faults& faults);

/// A viewpoint that layers are cut for.
struct CutView {
  Vec3 position{Vec3::Zero()};  ///< [m], world
  Quat orientation;             ///< orientation that looks along x, with z up
};

/// Layers parallel to the picture of one view. Depth is measured along the viewing direction.
class LayerCut {
 public:
  /// Makes one layer for everything.
  LayerCut() = default;
  /// @param nearest, farthest depths of the vegetation [m]; regions without vegetation are left
  /// out. A viewer within the vegetation has layers from itself on; the first one includes
  /// everything behind it.
  LayerCut(const CutView& view, const CutSettings& settings, double nearest, double farthest);

  int layers() const { return static_cast<int>(distances_.size()); }
  double depthOf(const Vec3& world) const { return -dot(axes_.out, Vec3(world - eye_)); }
  /// Returns the layer of a leaf by the position of its root (S3-03).
  int layerAt(const Vec3& root) const;
  /// Returns the depths between which the roots of the leaves of a layer lie; without an end before
  /// the first and behind the last layer [m].
  std::array<double, 2> depthsOf(int layer) const;
  const Vec3& eye() const { return eye_; }
  /// Returns the distance of a layer's middle from that of the first [m].
  double distance(int layer) const { return distances_[static_cast<std::size_t>(layer)]; }
  double last() const { return distances_.back(); }
  /// Returns the depth of a layer's middle [m].
  double middle(int layer) const { return first_ + distance(layer); }
  const Axes& axes() const { return axes_; }
  /// Returns whether layers for `view` would differ enough to be cut again.
  bool leftBy(const CutView& view, const CutSettings& settings) const;

 private:
  Vec3 eye_{Vec3::Zero()};
  Axes axes_;
  std::vector<double> ends_;            // depth of the end of each layer but the last
  std::vector<double> distances_{0.0};  // distances of the middles
  double first_{0.0};                   // depth of the first middle
  double thickness_{1.0};               // thickness of the thinnest layer; 1 m if there is none
};

}  // namespace vegetation_sim::canopy
