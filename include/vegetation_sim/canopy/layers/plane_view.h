// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plane/plane_field.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// Right-handed unit axes of a picture: right, up, and out of it towards the viewer.
struct Axes {
  Vec3 right{Vec3::UnitY()}, up{Vec3::UnitZ()}, out{Vec3::UnitX()};
};
/// Returns the axes of a camera that looks along the x axis of its orientation, with z up.
Axes axesOf(const Quat& orientation);
/// Convert a world vector to components along the axes, and back.
Vec3 into(const Axes& axes, const Vec3& world);
Vec3 outOf(const Axes& axes, const Vec3& components);

/// Mapping from the plane to the view: by rotations, or by the angles that the paper prints (E8).
enum class Projection { ROTATION, PRINTED };
/// A periodic field, or the paper's blend of the field with itself moved by half (S3-14).
enum class Tiling { PERIODIC, BLEND };
/// A formula as derived, or as the paper prints it.
enum class Formula { DERIVED, PRINTED };

/// Position of the simulation plane, as what a camera sees at a distance (S3-08).
struct PlaneSettings {
  Vec3 camera{Vec3(-5.0, 0.0, 1.5)};  ///< [m], world
  double yaw{0.0};                    ///< yaw of the camera: 0 is east, positive to the left [rad]
  double pitch{0.0};                  ///< positive is down [rad]
  double roll{0.0};                   ///< [rad]
  double distance{5.0};               ///< distance of the plane from the camera [m]
  double field_of_view{0.8};          ///< angle of view that the square fills [rad]
  Projection projection{Projection::ROTATION};
  Tiling tiling{Tiling::PERIODIC};
};
void describe(FieldVisitor& visitor, PlaneSettings& settings);
/// Returns the orientation of the camera, which looks along x.
Quat orientationOf(const PlaneSettings& settings);

/// The plane in the world, tiled without end and equal at any depth (S3-09, S3-10).
struct Plane {
  explicit Plane(const PlaneSettings& settings);

  Axes axes;
  Vec3 centre;
  double width;  ///< side of a tile [m]

  /// Returns the position of a world point in cells of a field of `size` cells; the tiles repeat.
  PlaneVector cellAt(const Vec3& world, int size) const;
};

/// Turns vectors in the plane into the axes of the viewer: right, up, and towards the viewer.
struct PlaneToView {
  /// Makes a view along the plane's own axes.
  PlaneToView() = default;
  /// Uses rotations (E8), which keep the length of every vector. Same bits on every processor.
  PlaneToView(const Axes& plane, const Axes& view);
  Vec3 apply(const Vec3& in_plane) const {
    return {dot(right, in_plane), dot(up, in_plane), dot(out, in_plane)};
  }
  Vec3 right{Vec3::UnitX()}, up{Vec3::UnitY()}, out{Vec3::UnitZ()};  ///< rows of the matrix
};

/// Makes a tile periodic: blends the field linearly with itself moved by half, first across and
/// then up (S3-14). The motion is weaker where both halves count.
void blendSeams(PlaneField& field);

}  // namespace vegetation_sim::canopy
