// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/canopy/pushing_bodies.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "forest/contact/contact_body.h"
#include "ros/conversions/grab_conversions.h"
#include "vegetation_sim/ros/conversions/stamps.h"

namespace vegetation_sim {
namespace {

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

// Returns the pose of the frame of the body; a walker has none.
Pose frameOf(const canopy::PushForce& force, const canopy::Canopy& canopy) {
  const auto body = canopy.bodies().find(force.body);
  if (force.frame.empty() || body == canopy.bodies().end()) return {force.point, {}};
  return compose(poseAt(body->second, canopy.snapshot().stamp), inverse(body->second.in_frame));
}

}  // namespace

std::vector<forest::Body> bodiesOf(const SubscribedCrowd& crowd) {
  std::vector<forest::Body> out;
  out.reserve(crowd.people().size());
  for (const SubscribedCrowd::Person& person : crowd.people())
    out.push_back(bodyOf(person, crowd.stamp()));
  return out;
}

std::vector<BodyChange> changesNearPlants(const canopy::Canopy& canopy,
                                          const std::vector<forest::Body>& present,
                                          std::size_t& left_out) {
  const forest::Bodies& known = canopy.bodies();
  std::set<std::string> near;
  std::vector<BodyChange> moved;
  left_out = 0;
  for (const forest::Body& body : present) {
    if (!canopy.isNear(body)) continue;
    if (near.size() >= canopy::MOST_PUSHING) {
      ++left_out;
      continue;
    }
    near.insert(body.id);
    const auto old = known.find(body.id);
    if (old == known.end() || old->second.stamp != body.stamp) moved.push_back({false, body});
  }
  std::vector<BodyChange> out;
  for (const auto& [id, body] : known)
    if (!near.count(id)) out.push_back({true, body});
  out.insert(out.end(), std::make_move_iterator(moved.begin()),
             std::make_move_iterator(moved.end()));
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
