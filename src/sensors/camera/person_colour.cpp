// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/camera/person_colour.h"

#include <cmath>

#include "crowd/body/body_skeleton.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::scan {
namespace {

using crowd::Clothes;
using crowd::HairCut;
using crowd::Part;
using crowd::Pattern;

const Vec3 EYE(0.10, 0.08, 0.07);
constexpr double HAND_FROM = 0.82;  // share of the forearm
constexpr double STRIPES = 7.0;     // on the chest
constexpr double YOKE_FROM = 0.8;   // share of the chest
constexpr double OPENING = 0.9;     // cosine of the half angle of an open jacket

bool isIn(double value, double low, double high) {
  return value > low && value < high;
}

// Heights on the head are shares of the way between the middles of the balls at its ends.
bool isHair(HairCut cut, double along, double facing) {
  if (cut == HairCut::BALD) return false;
  const bool is_long = cut == HairCut::LONG || cut == HairCut::BOB;
  const double nape = is_long ? -2.0 : -0.4;
  return along > (facing > 0.35             ? 1.25
                  : is_long && facing < 0.2 ? nape
                                            : 0.95) ||
         (facing < -0.1 && along > nape);
}

Vec3 headColour(const Clothes& clothes, const LimbPlace& place) {
  const double facing = dot(place.normal, place.front), along = place.along;
  if (isHair(clothes.cut, along, facing)) return clothes.hair;
  const double aside = std::fabs(dot(place.normal, cross(Vec3(Vec3::UnitZ()), place.front)));
  if (facing < 0.5) return clothes.skin;
  if (isIn(aside, 0.2, 0.5) && isIn(along, 0.55, 0.72)) return EYE;
  if (isIn(aside, 0.15, 0.6) && isIn(along, 0.8, 0.92)) return clothes.hair;
  if (aside < 0.3 && isIn(along, -0.42, -0.26))
    return clothes.skin.cwiseProduct(Vec3(0.8, 0.5, 0.5));
  const double bearded = aside > 0.35 || along < -0.2 ? clothes.beard : 0.0;
  if (along < 0.1) return clothes.skin + bearded * (clothes.hair - clothes.skin);
  return clothes.skin;
}

Vec3 chestColour(const Clothes& clothes, const LimbPlace& place) {
  const double band = STRIPES * place.along;
  bool is_second = false;
  if (clothes.pattern == Pattern::STRIPES) is_second = band - std::floor(band) < 0.5;
  if (clothes.pattern == Pattern::YOKE) is_second = place.along > YOKE_FROM;
  if (clothes.pattern == Pattern::OPEN) is_second = dot(place.normal, place.front) > OPENING;
  return is_second ? clothes.second : clothes.shirt;
}

}  // namespace

Vec3 personColour(const Clothes& clothes, const LimbPlace& place) {
  if (place.limb == static_cast<std::size_t>(Part::HEAD)) return headColour(clothes, place);
  if (place.limb == static_cast<std::size_t>(Part::CHEST)) return chestColour(clothes, place);
  if (place.limb == static_cast<std::size_t>(Part::SHOULDERS) && clothes.pattern == Pattern::YOKE)
    return clothes.second;
  if (place.limb >= static_cast<std::size_t>(Part::FOREARM) && place.along > HAND_FROM)
    return clothes.skin;
  return crowd::colourOf(clothes, place.limb);
}

Vec3 frontOf(const Rod& shoulders) {
  const Vec3 front = cross(Vec3(Vec3::UnitZ()), shoulders.axis);
  const double size = length(front);
  return size > 0.0 ? Vec3(front / size) : Vec3(Vec3::UnitX());
}

}  // namespace vegetation_sim::scan
