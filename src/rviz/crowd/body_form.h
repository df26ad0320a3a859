// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowd/body/body_skeleton.h"
#include "rviz/crowd/body_shapes.h"

namespace vegetation_sim::view {

/// Part of the form of a body: rings along an axis, in heights of the person.
struct FormTube {
  enum class Kind { TRUNK, HEAD, ARM, LEG, SHOE, SKIRT, HAIR, EYE, IRIS, EAR, FINGER, THUMB, TAIL };
  Kind kind;
  int side;  ///< 0: left, 1: right or middle
  Vec3 origin, along, left, front;
  FormRings rings;

  Vec3 centreOf(const FormRing& ring) const {
    return origin + ring.along * along + ring.forward * front;
  }
  /// Returns about the distance of a place from the surface, negative inside.
  double distance(const Vec3& place) const;
  /// Returns whether it lies over the body, of whose form it is no part.
  bool isLoose() const { return kind >= Kind::SKIRT; }
  /// Returns whether it is drawn from near only.
  bool isClose() const { return kind >= Kind::EYE && kind <= Kind::THUMB; }
};

/// Form of a person of height 1 who stands at the origin, looks along x and holds the arms away
/// from the trunk. Its surface is smooth where the parts meet.
class BodyForm {
 public:
  BodyForm(crowd::Outfit outfit, bool long_sleeves);

  const std::vector<FormTube>& tubes() const { return tubes_; }
  /// Returns about the distance from the surface, negative inside. @param without a tube that is
  /// left out, or null.
  double distance(const Vec3& place, const FormTube* without = nullptr) const;
  /// Returns the outward unit normal of the surface through a place.
  Vec3 normal(const Vec3& place) const;

 private:
  std::vector<FormTube> tubes_;
};

/// Returns eyes, ears that hair leaves free, and a tail of hair, which lie over the head of a
/// BodyForm.
std::vector<FormTube> headTubes(crowd::HairCut cut);

/// Returns the fingers of both hands, which begin within the palms.
std::vector<FormTube> fingerTubes(const BodyForm& form);

/// Axes of a hand: to its thumb, and away from its palm.
struct HandAxes {
  Vec3 thumb, back;
};
HandAxes handAxes(const FormTube& arm);

/// Returns the skeleton in the pose of a BodyForm.
crowd::Skeleton formSkeleton();

/// Frames that vertices of a body follow.
enum class Bone : std::uint8_t {
  PELVIS,
  CHEST,
  HEAD,
  THIGH,
  SHANK = THIGH + 2,
  FOOT = SHANK + 2,
  UPPER_ARM = FOOT + 2,
  FOREARM = UPPER_ARM + 2,
  COUNT = FOREARM + 2
};
constexpr std::size_t BONES = static_cast<std::size_t>(Bone::COUNT);

/// Returns the index of a bone. @param side of those that exist twice.
inline std::uint8_t boneOf(Bone bone, int side = 0) {
  return static_cast<std::uint8_t>(static_cast<int>(bone) + side);
}

using BoneAxes = Eigen::Matrix3d;

/// Axes and origin of a bone.
struct BoneFrame {
  BoneAxes axes{BoneAxes::Identity()};
  Vec3 origin{Vec3::Zero()};
};
using BoneFrames = std::array<BoneFrame, BONES>;
/// Returns the frames of a skeleton. @param left unit vector to the left of the walker.
BoneFrames framesOf(const crowd::Skeleton& skeleton, const Vec3& left);

}  // namespace vegetation_sim::view
