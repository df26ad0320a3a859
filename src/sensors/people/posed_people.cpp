// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/people/posed_people.h"

namespace vegetation_sim::scan {
namespace {

using crowd::Part;

/// Radii at the ends of a limb as shares of its skeleton's, at most 1.
struct Taper {
  double base{1.0}, tip{1.0};
};

Taper taperOf(std::size_t part) {
  const auto is = [&](Part one) {
    return part >= static_cast<std::size_t>(one) && part < static_cast<std::size_t>(one) + 2;
  };
  if (part == static_cast<std::size_t>(Part::HEAD)) return {0.64, 0.8};
  if (part == static_cast<std::size_t>(Part::CHEST)) return {0.9, 0.85};
  if (part == static_cast<std::size_t>(Part::SHOULDERS)) return {0.75, 0.75};
  if (is(Part::THIGH)) return {1.0, 0.75};
  if (is(Part::SHANK)) return {1.0, 0.75};
  if (is(Part::UPPER_ARM)) return {1.0, 0.85};
  if (is(Part::FOREARM)) return {1.0, 0.75};
  return {};
}

// Returns a rod within the capsule of a limb. A head keeps its top and has a chin above its neck.
Rod rodOf(const crowd::Limb& limb, std::size_t part) {
  const Taper taper = taperOf(part);
  Rod out = rodBetween(limb.from, limb.to, taper.base * limb.radius, taper.tip * limb.radius);
  if (part != static_cast<std::size_t>(Part::HEAD)) return out;
  const double up = 0.5 * out.length;
  return rodBetween(limb.from + up * out.axis, limb.to + (limb.radius - out.tip_radius) * out.axis,
                    out.base_radius, out.tip_radius);
}

}  // namespace

void People::set(const std::vector<Person>& people) {
  limbs_.clear();
  rods_.clear();
  for (const Person& person : people)
    for (std::size_t part = 0; part < person.skeleton.size(); ++part) {
      const crowd::Limb& limb = person.skeleton[part];
      limbs_.push_back({person.id, static_cast<int>(part)});
      rods_.push_back(rodOf(limb, part));
    }
  const Vec3 origin = rods_.empty() ? Vec3(Vec3::Zero()) : rods_.front().base;
  rod_tree_.build(rods_, std::vector<double>(rods_.size(), 0.0), origin);
}

void People::meet(const Ray& ray, const FloatRay& narrow, Hit& nearest) const {
  if (limbs_.empty()) return;
  RankedHit ranked(nearest);
  rod_tree_.visit(ray, narrow, nearest, [&](std::size_t limb) {
    ranked.offer(limb + 1, [&](Hit& hit) { return meetLimb(limb, ray, hit); });
  });
}

bool People::meetLimb(std::size_t index, const Ray& ray, Hit& nearest) const {
  const Limb& limb = limbs_[index];
  Meeting meeting;
  if (!scan::meet(ray, rods_[index], nearest.distance, meeting)) return false;
  nearest = {meeting.distance, Label::PERSON, limb.person, limb.part, meeting.cosine};
  return true;
}

}  // namespace vegetation_sim::scan
