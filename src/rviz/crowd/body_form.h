// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "crowd/body/body_skeleton.h"

namespace vegetation_sim::view {

/// The cover of a place of a body.
enum class Cover { SKIN, FACE, HAIR, SHIRT, COLLAR, SLEEVE, BELT, TROUSERS, SHOES, SOLES };

/// Ellipse around an axis of a body, in heights of the person.
struct FormRing {
  double along, broad, deep;  ///< along the axis; half axes to the left and to the front
  double forward{0.0};        ///< of the centre; of shoes upwards
  Cover cover{Cover::SKIN};
  bool fine{false};  ///< is left out of small bodies
};

/// Part of the form of a body: rings along an axis, in heights of the person.
struct FormTube {
  enum class Kind { TRUNK, HEAD, LONG_HAIR, ARM, LEG, SHOE };
  Kind kind;
  int side;  ///< 0: left, 1: right or middle
  Vec3 origin, along, left, front;
  std::vector<FormRing> rings;

  Vec3 centreOf(const FormRing& ring) const {
    return origin + ring.along * along + ring.forward * front;
  }
  /// Returns about the distance of a place from the surface, negative inside.
  double distance(const Vec3& place) const;
};

/// Form of a person of height 1 who stands at the origin, looks along x and holds the arms away
/// from the trunk. Its surface is smooth where the parts meet.
class BodyForm {
 public:
  explicit BodyForm(bool long_hair);

  const std::vector<FormTube>& tubes() const { return tubes_; }
  /// Returns about the distance from the surface, negative inside. @param without a tube that is
  /// left out, or null.
  double distance(const Vec3& place, const FormTube* without = nullptr) const;
  /// Returns the outward unit normal of the surface through a place.
  Vec3 normal(const Vec3& place) const;

 private:
  std::vector<FormTube> tubes_;
};

/// Returns the skeleton in the pose of a BodyForm.
crowd::Skeleton formSkeleton();

}  // namespace vegetation_sim::view
