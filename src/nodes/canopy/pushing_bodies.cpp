// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/pushing_bodies.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "forest/contact/contact_body.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

bool isWalker(const std::string& id) {
  return id.rfind(WALKER_PREFIX, 0) == 0;
}

// Returns the pose of the frame of the body; a walker has none.
Pose frameOf(const canopy::PushForce& force, const canopy::Canopy& canopy) {
  const auto body = canopy.bodies().find(force.body);
  if (force.frame.empty() || body == canopy.bodies().end()) return {force.point, {}};
  return compose(poseAt(body->second, canopy.snapshot().stamp), inverse(body->second.in_frame));
}

}  // namespace

forest::Body bodyOf(const SubscribedCrowd::Person& person, Nanoseconds stamp) {
  const crowd::Walker& walker = person.walker;
  const double radius = std::max(walker.radius, forest::SMALLEST_BODY);
  forest::Body out;
  out.id = WALKER_PREFIX + std::to_string(walker.id);
  out.shape = forest::Shape::CAPSULE;
  out.size = Vec3(radius, 0.0, std::max(0.0, walker.height - 2.0 * radius));
  out.pose.position =
      Vec3(walker.position.x, walker.position.y, person.ground + 0.5 * walker.height);
  out.velocity = Vec3(walker.velocity.x, walker.velocity.y, 0.0);
  out.stamp = stamp;
  return out;
}

std::vector<BodyChange> changesOfWalkers(const canopy::Canopy& canopy, const SubscribedCrowd& crowd,
                                         Nanoseconds now, std::size_t& left_out) {
  std::vector<BodyChange> out;
  std::set<std::string> near;
  const forest::Bodies& known = canopy.bodies();
  std::size_t count = known.size();
  left_out = 0;
  if (std::fabs(secondsBetween(crowd.stamp(), now)) <= STALE_BODY)
    for (const SubscribedCrowd::Person& person : crowd.people()) {
      const forest::Body body = bodyOf(person, crowd.stamp());
      if (!canopy.isNear(body)) continue;
      const auto old = known.find(body.id);
      const bool comes = old == known.end();
      if (comes && ++count > canopy::MOST_PUSHING) {
        ++left_out;
        continue;
      }
      near.insert(body.id);
      if (comes || old->second.stamp != body.stamp) out.push_back({false, body});
    }
  for (const auto& [id, body] : known)
    if (isWalker(id) && !near.count(id)) out.push_back({true, body});
  return out;
}

PlantContacts contactsOf(const canopy::Canopy& canopy) {
  PlantContacts out;
  out.header.stamp = toStamp(canopy.snapshot().stamp);
  for (const canopy::PushForce& force : canopy.pushForces())
    out.contacts.push_back(toMsg(force, frameOf(force, canopy)));
  return out;
}

}  // namespace vegetation_sim
