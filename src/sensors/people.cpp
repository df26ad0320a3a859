// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/people.h"

namespace vegetation_sim::scan {

void People::set(const std::vector<Person>& people) {
  limbs_.clear();
  std::vector<Box> items;
  for (const Person& person : people)
    for (std::size_t part = 0; part < person.skeleton.size(); ++part) {
      const crowd::Limb& limb = person.skeleton[part];
      limbs_.push_back({person.id, static_cast<int>(part),
                        rodBetween(limb.from, limb.to, limb.radius, limb.radius)});
      items.push_back(boxOf(limbs_.back().rod));
    }
  boxes_.build(items);
}

void People::meet(const Ray& ray, Hit& nearest) const {
  boxes_.visit(ray, nearest, [&](std::size_t limb) { meetLimb(limb, ray, nearest); });
}

void People::meetLimb(std::size_t index, const Ray& ray, Hit& nearest) const {
  const Limb& limb = limbs_[index];
  Meeting meeting;
  if (scan::meet(ray, limb.rod, nearest.distance, meeting))
    nearest = {meeting.distance, Label::PERSON, limb.person, limb.part, meeting.cosine};
}

}  // namespace vegetation_sim::scan
