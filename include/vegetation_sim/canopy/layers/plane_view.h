// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vegetation_sim/canopy/plane/plane_field.h"
#include "vegetation_sim/core/config/fields.h"
#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::canopy {

/// Right-handed axes of a picture: to its right, up, and out of it towards who looks. All unit.
struct Axes {
  Vec3 right{Vec3::UnitY()}, up{Vec3::UnitZ()}, out{Vec3::UnitX()};
};
/// Of a camera that looks along the x axis of its orientation, z up in the picture.
Axes axesOf(const Quat& orientation);
/// Components of a world vector along the axes, and back.
Vec3 into(const Axes& axes, const Vec3& world);
Vec3 outOf(const Axes& axes, const Vec3& components);

/// From the plane to the view: by rotations, or by the angles that the paper prints (E8).
enum class Projection { ROTATION, PRINTED };
/// A periodic field, or the paper's blend of the field with itself moved by half (S3-14).
enum class Tiling { PERIODIC, BLEND };
/// A formula as derived, or as the paper prints it.
enum class Formula { DERIVED, PRINTED };

/// Where the simulation plane is: what a camera sees at a distance (S3-08).
struct PlaneSettings {
  Vec3 camera{Vec3(-5.0, 0.0, 1.5)};  ///< [m], world
  double yaw{0.0};                    ///< of the way it looks, 0 to the east, left turns up [rad]
  double pitch{0.0};                  ///< down is more than 0 [rad]
  double roll{0.0};                   ///< [rad]
  double distance{5.0};               ///< of the plane from the camera [m]
  double field_of_view{0.8};          ///< that the square fills [rad]
  Projection projection{Projection::ROTATION};
  Tiling tiling{Tiling::PERIODIC};
};
void describe(FieldVisitor& visitor, PlaneSettings& settings);
/// Of the camera; it looks along x.
Quat orientationOf(const PlaneSettings& settings);

/// The plane in the world, tiled without end and the same at any depth (S3-09, S3-10).
struct Plane {
  explicit Plane(const PlaneSettings& settings);

  Axes axes;
  Vec3 centre;
  double width;  ///< of a tile [m]

  /// Place of a world point in cells of a field of `size` cells; beyond one tile is the next.
  PlaneVector cellAt(const Vec3& world, int size) const;
};

/// Turns what moves in the plane into what a viewer sees: to the right, up, and towards him.
struct PlaneToView {
  /// A view along the plane's own axes.
  PlaneToView() = default;
  /// With rotations (E8): the length of every vector is kept. Same bits everywhere.
  PlaneToView(const Axes& plane, const Axes& view);
  Vec3 apply(const Vec3& in_plane) const {
    return {dot(right, in_plane), dot(up, in_plane), dot(out, in_plane)};
  }
  Vec3 right{Vec3::UnitX()}, up{Vec3::UnitY()}, out{Vec3::UnitZ()};  ///< rows of the matrix
};

/// Makes any square tile: the field and itself moved by half, linearly blended, first across and
/// then up (S3-14). Weakens the motion where both halves count; a periodic field needs it not.
void blendSeams(PlaneField& field);

}  // namespace vegetation_sim::canopy
