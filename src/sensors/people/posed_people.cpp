// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/people/posed_people.h"

namespace vegetation_sim::scan {

void People::set(const std::vector<Person>& people) {
  limbs_.clear();
  rods_.clear();
  for (const Person& person : people)
    for (std::size_t part = 0; part < person.skeleton.size(); ++part) {
      const crowd::Limb& limb = person.skeleton[part];
      limbs_.push_back({person.id, static_cast<int>(part)});
      rods_.push_back(rodBetween(limb.from, limb.to, limb.radius, limb.radius));
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
