// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/body_form.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rviz/crowd/body_hair.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

using crowd::Part;
using P = crowd::Proportions;
using Kind = FormTube::Kind;

constexpr double HIP = P::THIGH + P::SHANK + P::ANKLE;  // height of the hips
// Places of the eyes; they look slightly aside, as the face is round.
constexpr double EYE_HALF = 0.0183, EYE_UP = 0.0625, EYE_FORWARD = 0.0475;
constexpr double EYE_ASIDE = 0.34, EYE_AHEAD = 0.94;
constexpr double EAR_HALF = 0.041, EAR_UP = 0.0560, EAR_FORWARD = -0.009, EAR_BACK = 0.45;
constexpr double ARM_OUT = 0.25;    // sine of the angle of the arms
constexpr double HAND_TURN = 0.1;   // by how much thumbs are turned to the body, in turns
constexpr double ARM_DROP = 0.018;  // from the top of the shoulder, where skeletons have the joint

// A finger from its knuckle, or the thumb: places along the arm and to the thumb, and tangents of
// its angles to the thumb and to the palm.
struct Finger {
  double from, aside, length, radius, spread, bent;
};
constexpr Finger FINGERS[] = {{0.371, 0.0158, 0.043, 0.0054, 0.01, 0.00},
                              {0.373, 0.0054, 0.048, 0.0056, 0.00, 0.00},
                              {0.371, -0.0050, 0.045, 0.0054, -0.01, 0.02},
                              {0.367, -0.0146, 0.037, 0.0048, -0.03, 0.04},
                              {0.338, 0.0165, 0.043, 0.0068, 0.42, 0.06}};

// Returns the smaller of two distances, less around places where they are about equal.
double smoothMinimum(double a, double b, double reach) {
  const double part = saturate(0.5 + 0.5 * (b - a) / reach);
  return b + (a - b) * part - reach * part * (1.0 - part);
}

Vec3 armDirection(int side) {
  return {0.0, (side == 0 ? 1.0 : -1.0) * ARM_OUT, -std::sqrt(1.0 - ARM_OUT * ARM_OUT)};
}

Vec3 onSide(int side, double half, double z) {
  return {0.0, (side == 0 ? half : -half), z};
}

Vec3 unit(const Vec3& v) {
  return v / std::max(1e-9, length(v));
}

// Returns axes of which the first is `main` and the second as near to `side` as possible.
BoneAxes axesAlong(const Vec3& main, const Vec3& side) {
  const Vec3 first = unit(main), second = unit(side - dot(side, first) * first);
  BoneAxes out;
  out.col(0) = first;
  out.col(1) = second;
  out.col(2) = cross(first, second);
  return out;
}

}  // namespace

double FormTube::distance(const Vec3& place) const {
  const Vec3 way = place - origin;
  const double s = dot(way, along);
  std::size_t next = 1;
  while (next + 1 < rings.size() && rings[next].along < s) ++next;
  const FormRing &a = rings[next - 1], &b = rings[next];
  const double part = saturate((s - a.along) / std::max(1e-9, b.along - a.along));
  const auto mixed = [&](double FormRing::*value) {
    return (1.0 - part) * a.*value + part * b.*value;
  };
  const double y = dot(way, left), x = dot(way, front) - mixed(&FormRing::forward);
  const double out = std::hypot(y / mixed(&FormRing::broad), x / mixed(&FormRing::deep));
  const double radius = out > 1e-6 ? std::hypot(x, y) / out
                                   : std::min(mixed(&FormRing::broad), mixed(&FormRing::deep));
  const double aside = (out - 1.0) * radius;
  const double beyond = std::max({0.0, rings.front().along - s, s - rings.back().along});
  return beyond > 0.0 ? std::hypot(beyond, std::max(0.0, aside)) : aside;
}

BodyForm::BodyForm(crowd::Outfit outfit, bool long_sleeves) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), hips(0.0, 0.0, HIP);
  const bool coat = outfit == crowd::Outfit::COAT, skirt = outfit == crowd::Outfit::SKIRT;
  tubes_.push_back({Kind::TRUNK, 1, hips, z, y, x, trunkRings()});
  tubes_.push_back({Kind::HEAD, 1, Vec3(0.0, 0.0, P::NECK), z, y, x, headRings()});
  for (int side = 0; side < 2; ++side) {
    const Vec3 down = armDirection(side);
    tubes_.push_back({Kind::ARM, side, onSide(side, P::SHOULDER_HALF, P::SHOULDER - ARM_DROP), down,
                      cross(x, down), x, armRings(!long_sleeves)});
    tubes_.push_back({Kind::LEG, side, onSide(side, P::HIP_HALF, HIP), -z, y, x,
                      legRings(skirt || outfit == crowd::Outfit::SHORTS)});
    tubes_.push_back({Kind::SHOE, side, onSide(side, P::HIP_HALF, P::SOLE) - P::FOOT_BACK * x, x, y,
                      z, shoeRings()});
  }
  if (coat || skirt) tubes_.push_back({Kind::SKIRT, 1, hips, z, y, x, skirtRings(coat)});
}

std::vector<FormTube> headTubes(crowd::HairCut cut) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  std::vector<FormTube> out;
  for (int side = 0; side < 2; ++side) {
    const Vec3 ahead = EYE_AHEAD * x + onSide(side, EYE_ASIDE, 0.0);
    const Vec3 across(-ahead.y(), ahead.x(), 0.0);
    const Vec3 middle = onSide(side, EYE_HALF, P::NECK + EYE_UP) + EYE_FORWARD * x;
    out.push_back({Kind::EYE, side, middle, ahead, across, z, eyeRings()});
    if (cut != crowd::HairCut::LONG && cut != crowd::HairCut::BOB)
      out.push_back({Kind::EAR, side, onSide(side, EAR_HALF, P::NECK + EAR_UP) + EAR_FORWARD * x,
                     unit(onSide(side, 1.0, 0.0) - EAR_BACK * x),
                     unit(x + onSide(side, EAR_BACK, 0.0)), z, earRings()});
    out.push_back({Kind::IRIS, side, middle, ahead, across, z, irisRings()});
  }
  const FormRings& tail = HairForm::tailRings(cut);
  if (!tail.empty()) out.push_back({Kind::TAIL, 1, Vec3(0.0, 0.0, P::NECK), z, y, x, tail});
  return out;
}

HandAxes handAxes(const FormTube& arm) {
  const double inward = arm.side == 0 ? -1.0 : 1.0;
  const SinCos turn = sinCosTurns(HAND_TURN);
  return {turn.cos * arm.front + inward * turn.sin * arm.left,
          turn.sin * arm.front - inward * turn.cos * arm.left};
}

std::vector<FormTube> fingerTubes(const BodyForm& form) {
  std::vector<FormTube> out;
  for (const FormTube& arm : form.tubes()) {
    if (arm.kind != Kind::ARM) continue;
    const HandAxes hand = handAxes(arm);
    for (const Finger& finger : FINGERS) {
      const Vec3 at = arm.origin + finger.from * arm.along + finger.aside * hand.thumb;
      const Vec3 way = arm.along + finger.spread * hand.thumb - finger.bent * hand.back;
      const BoneAxes axes = axesAlong(way, hand.back);
      out.push_back({finger.spread > 0.3 ? Kind::THUMB : Kind::FINGER, arm.side, at, axes.col(0),
                     axes.col(2), -axes.col(1), fingerRings(finger.length, finger.radius)});
    }
  }
  return out;
}

double BodyForm::distance(const Vec3& place, const FormTube* without) const {
  constexpr double FAR = 1e6;
  double trunk = FAR, head = FAR, arms = FAR, legs[2] = {FAR, FAR}, shoes[2] = {FAR, FAR};
  for (const FormTube& tube : tubes_) {
    if (&tube == without || tube.isLoose()) continue;
    const double own = tube.distance(place);
    const auto side = static_cast<std::size_t>(tube.side);
    switch (tube.kind) {
      case Kind::TRUNK:
        trunk = own;
        break;
      case Kind::HEAD:
        head = own;
        break;
      case Kind::ARM:
        arms = std::min(arms, own);
        break;
      case Kind::LEG:
        legs[side] = own;
        break;
      default:
        shoes[side] = own;
        break;
    }
  }
  double out = smoothMinimum(trunk, arms, 0.045);
  const double left = smoothMinimum(legs[0], shoes[0], 0.012);
  const double right = smoothMinimum(legs[1], shoes[1], 0.012);
  out = smoothMinimum(out, std::min(left, right), 0.04);
  return smoothMinimum(out, head, 0.02);
}

Vec3 BodyForm::normal(const Vec3& place) const {
  constexpr double STEP = 2e-3;
  Vec3 out;
  for (int i = 0; i < 3; ++i) {
    Vec3 low = place, high = place;
    low[i] -= STEP;
    high[i] += STEP;
    out[i] = distance(high) - distance(low);
  }
  return out / std::max(1e-12, length(out));
}

crowd::Skeleton formSkeleton() {
  crowd::Skeleton out;
  const auto put = [&](Part part, int side, const Vec3& from, const Vec3& to) {
    out[static_cast<std::size_t>(part) + static_cast<std::size_t>(side)] = {from, to, 0.0};
  };
  const Vec3 up = Vec3::UnitZ(), pelvis = HIP * up, chest = P::SHOULDER * up, neck = P::NECK * up;
  put(Part::PELVIS, 0, onSide(0, 0.04, HIP), onSide(1, 0.04, HIP));
  put(Part::CHEST, 0, pelvis + 0.05 * up, chest - 0.03 * up);
  put(Part::SHOULDERS, 0, onSide(0, 0.075, P::SHOULDER), onSide(1, 0.075, P::SHOULDER));
  put(Part::NECK, 0, chest, neck);
  put(Part::HEAD, 0, neck, neck + 0.06 * up);
  for (int side = 0; side < 2; ++side) {
    const Vec3 hip = onSide(side, P::HIP_HALF, HIP), knee = hip - P::THIGH * up;
    const Vec3 ankle = knee - P::SHANK * up, sole(0.0, hip.y(), P::SOLE);
    put(Part::THIGH, side, hip, knee);
    put(Part::SHANK, side, knee, ankle);
    put(Part::FOOT, side, sole - P::FOOT_BACK * Vec3::UnitX(),
        sole + P::FOOT_FRONT * Vec3::UnitX());
    const Vec3 shoulder = onSide(side, P::SHOULDER_HALF, P::SHOULDER);
    const Vec3 elbow = shoulder + P::UPPER_ARM * armDirection(side);
    put(Part::UPPER_ARM, side, shoulder, elbow);
    put(Part::FOREARM, side, elbow, elbow + P::FOREARM * armDirection(side));
  }
  return out;
}

BoneFrames framesOf(const crowd::Skeleton& skeleton, const Vec3& left) {
  BoneFrames out;
  const auto set = [&](std::uint8_t bone, const Vec3& origin, const Vec3& main, const Vec3& side) {
    out[bone] = {axesAlong(main, side), origin};
  };
  const crowd::Limb& hips = limbOf(skeleton, Part::PELVIS);
  const crowd::Limb& chest = limbOf(skeleton, Part::CHEST);
  const crowd::Limb& shoulders = limbOf(skeleton, Part::SHOULDERS);
  const crowd::Limb& head = limbOf(skeleton, Part::HEAD);
  const Vec3 across = unit(hips.from - hips.to), wide = unit(shoulders.from - shoulders.to);
  const Vec3 spine = chest.to - chest.from;
  set(boneOf(Bone::PELVIS), 0.5 * (hips.from + hips.to), unit(spine) + Vec3::UnitZ(), across);
  set(boneOf(Bone::CHEST), 0.5 * (shoulders.from + shoulders.to), spine, wide);
  set(boneOf(Bone::HEAD), head.from, head.to - head.from, unit(wide + left));
  const std::pair<Bone, Part> limbs[] = {{Bone::THIGH, Part::THIGH},
                                         {Bone::SHANK, Part::SHANK},
                                         {Bone::FOOT, Part::FOOT},
                                         {Bone::UPPER_ARM, Part::UPPER_ARM},
                                         {Bone::FOREARM, Part::FOREARM}};
  for (const auto& [bone, part] : limbs) {
    for (int side = 0; side < 2; ++side) {
      const crowd::Limb& limb = limbOf(skeleton, part, side);
      set(boneOf(bone, side), limb.from, limb.to - limb.from, left);
    }
  }
  return out;
}

}  // namespace vegetation_sim::view
