// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "forest/contact/contact_finder.h"

#include <algorithm>

#include "forest/contact/contact_pair.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::forest {
namespace {

using physics::Bar;
using physics::Contact;
using physics::Proximity;

// Pairs within this gap keep their normal [m].
constexpr double HELD = 1e-3;
// A branch farther beyond the body than this has been passed [m].
constexpr double LOST = 5e-3;
// A bar lies flat on a body where the gap changes by less than this slope over more than this
// length.
constexpr double FLAT = 0.1, SPREAD = 0.02;  // [m/m], [m]
constexpr double NOWHERE = 1e9;              // [m]
// Contacts of thin wood are harder, so that it does not penetrate where thick wood presses it.
// Radii up to THIN are thin, from THIN + FADE on thick [m].
constexpr double THIN = 0.01, FADE = 2e-3, THIN_BEARS = 5.0;

// The persistent contacts of a body.
struct Touched {
  const PersistentContact *first, *last;

  Touched(const PersistentContacts& persistent, const std::string& body) {
    first = persistent.data();
    const PersistentContact* end = first + persistent.size();
    while (first != end && first->body != body) ++first;
    last = first;
    while (last != end && last->body == body) ++last;
  }
};

// The persistent contacts of a body and a branch: up to two, and released ones.
struct Held {
  const PersistentContact *first, *last;

  Held(const Touched& body, int branch) {
    const auto before = [](const PersistentContact& a, int b) { return a.branch < b; };
    first = last = std::lower_bound(body.first, body.last, branch, before);
    while (last != body.last && last->branch == branch) ++last;
  }
  // Returns the one with the largest force among those that touch; its normal is the branch's.
  const PersistentContact* touching() const {
    const PersistentContact* out = nullptr;
    for (const PersistentContact* t = first; t != last; ++t)
      if (!t->released && (t->force > 0.0 || t->gap < HELD) && (!out || t->force > out->force))
        out = t;
    return out;
  }
  // Returns the force that continues at `along`: each contact goes to the nearer of two places, the
  // lower one if equal.
  double at(double along, double other) const {
    double out = 0.0;
    for (const PersistentContact* t = first; t != last; ++t) {
      const double way = std::fabs(t->along - along), others = std::fabs(t->along - other);
      if (!t->released && (way < others || (way == others && along < other))) out += t->force;
    }
    return out;
  }
};

// Finds where a pair touches or will touch first; returns false if it does not within the horizon.
bool meet(const Placed& placed, const Pair& pair, const Held& held, double horizon,
          Proximity& out) {
  const Bar local = placed.local(pair.bar);
  if (const PersistentContact* known = held.touching()) {
    const Proximity free = nearest(placed.shape, local);
    if (dot(free.normal, known->normal) < 0.0 && free.gap > LOST) return false;
    out = nearest(placed.shape, local, known->normal);
    if (out.gap < SKIN || known->force > 0.0) return true;
  }
  const physics::Meeting meeting =
      sweep(placed.shape, local, rotate(placed.to_body, pair.base_velocity),
            rotate(placed.to_body, pair.tip_velocity), horizon);
  if (!meeting.met || meeting.time <= 0.0) {
    out = nearest(placed.shape, local);
    return out.gap < SKIN;
  }
  // The present gap along the normal of the predicted contact.
  out = meeting.there;
  const double part = out.along / pair.bar.length;
  const Vec3 velocity = (1.0 - part) * pair.base_velocity + part * pair.tip_velocity;
  out.gap -= meeting.time * dot(rotate(placed.to_body, velocity), out.normal);
  return true;
}

// Returns the slope of the distance from the body along the bar; it increases, because distance is
// convex.
double slopeAt(const Placed& placed, const Bar& local, double along, Vec3& normal) {
  signedDistance(placed.shape, local.at(along), normal);
  return dot(normal, local.axis);
}

// Returns the end of the flat part of a bar, from a point of it towards `end`.
double endOfFlat(const Placed& placed, const Bar& local, double along, double end) {
  Vec3 normal;
  double outside = end;
  if (std::fabs(slopeAt(placed, local, end, normal)) < FLAT) return end;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (along + outside);
    (std::fabs(slopeAt(placed, local, middle, normal)) < FLAT ? along : outside) = middle;
  }
  return along;
}

// A flat bar turns about its nearest point, so the far end of the flat part is a contact as well.
bool liesFlat(const Placed& placed, const Pair& pair, const Proximity& found, double near,
              Proximity& out) {
  const Bar local = placed.local(pair.bar);
  const double low = endOfFlat(placed, local, found.along, 0.0),
               high = endOfFlat(placed, local, found.along, local.length);
  out.along = found.along - low > high - found.along ? low : high;
  if (std::fabs(out.along - found.along) < SPREAD) return false;
  const double distance = signedDistance(placed.shape, local.at(out.along), out.normal);
  out.gap = distance - local.radiusAt(out.along);
  return out.gap < near && dot(out.normal, found.normal) > 0.5;
}

// A branch beyond the middle of the body passes softly: the force limit fades until it leaves the
// far side.
double shareOf(const Placed& placed, const Proximity& found, double radius) {
  const double half = supportOf(placed.shape, found.normal) + radius;
  return 1.0 - smootherStep(-found.gap / half - 1.0);
}

Contact contactOf(const Placed& placed, const Pair& pair, const Proximity& found) {
  Contact out;
  out.along = found.along;
  out.normal = rotate(placed.pose.orientation, found.normal);
  out.gap = found.gap;
  const double radius = pair.bar.radiusAt(found.along);
  out.share = shareOf(placed, found, radius);
  out.hardness = THIN_BEARS - (THIN_BEARS - 1.0) * smootherStep((radius - THIN) / FADE);
  out.surface = placed.velocity(pair.bar.at(found.along) - (radius + found.gap) * out.normal);
  return out;
}

}  // namespace

// The base of a branch lies on the axis of its parent. The branch emerges where its far side leaves
// the side or the end of the parent.
double findExposedStart(const Skeleton& skeleton, int branch) {
  const Branch& b = skeleton.branches[static_cast<std::size_t>(branch)];
  if (b.parent < 0) return 0.0;
  const Branch& bearer = skeleton.branches[static_cast<std::size_t>(b.parent)];
  const Vec3 axis = axisZ(bearer.rest.orientation), own = axisZ(b.rest.orientation);
  const double across = length(cross(axis, own)), along = dot(axis, own);
  const double radius =
      bearer.base_radius + (bearer.tip_radius - bearer.base_radius) * (b.h / bearer.length);
  const double wall = radius - b.base_radius, rest = bearer.length - b.h;
  if (wall <= 0.0 || rest <= 0.0) return 0.0;
  double out = 0.5 * b.length;
  if (across * out > wall) out = wall / across;
  if (along * out > rest) out = rest / along;
  return out;
}

std::vector<Contact> ContactFinder::findContacts(const ContactTree& tree, const Bodies& bodies,
                                                 Nanoseconds from, Nanoseconds to,
                                                 PersistentContacts& persistent) const {
  if (trace_.on_search) trace_.on_search(tree, from, persistent);
  const double h = secondsBetween(from, to);
  std::vector<Contact> out;
  PersistentContacts kept;
  const LinkBounds bounds(tree);
  for (const auto& entry : bodies) {
    const Placed placed(entry.second, tree.foot, from);
    const Touched touched(persistent, entry.first);
    if (touched.first == touched.last && bounds.isFar(placed, h)) continue;
    for (std::size_t i = 0; i < tree.branches.size(); ++i) {
      const Pair pair(tree, i, placed);
      const Held held(touched, tree.branches[i]);
      Proximity found, far;
      const bool meets = leastGap(placed, pair.bar) <= pair.reach(h) &&
                         meet(placed, pair, held, LOOK_AHEAD * h, found);
      const bool flat = meets && liesFlat(placed, pair, found, pair.reach(h), far);
      const auto add = [&](const Proximity& place, double force, bool leaving = false) {
        Contact contact = contactOf(placed, pair, place);
        contact.link = static_cast<int>(i);
        contact.touch = kept.size();
        contact.force = force;
        kept.push_back(
            {entry.first, tree.branches[i], place.normal, place.gap, force, place.along, leaving});
        out.push_back(contact);
      };
      if (meets) add(found, held.at(found.along, flat ? far.along : NOWHERE));
      if (flat) add(far, held.at(far.along, found.along));
      // Contacts without pressure decay.
      for (const PersistentContact* t = held.first; t != held.last; ++t)
        if (t->force > 0.0 && (t->released || !meets))
          add({t->along, t->normal, SKIN}, t->force, true);
    }
  }
  persistent = std::move(kept);
  return out;
}

void ContactFinder::recordForces(const ContactTree& tree, const Bodies& bodies,
                                 const std::vector<Contact>& contacts, Nanoseconds to,
                                 PersistentContacts& persistent,
                                 std::vector<Reaction>& reactions) const {
  if (trace_.on_step) trace_.on_step(tree, contacts, to);
  for (const Contact& contact : contacts) {
    PersistentContact& touch = persistent[contact.touch];
    touch.force = contact.force;
    const auto body = bodies.find(touch.body);
    if (contact.force <= 0.0 || body == bodies.end()) continue;
    const Pose& pose = tree.start.pose[static_cast<std::size_t>(contact.link)];
    Reaction reaction;
    reaction.kind = Reaction::CONTACT;
    reaction.body = touch.body;
    reaction.frame = body->second.frame;
    reaction.at = {tree.tree, touch.branch, contact.along};
    reaction.point = tree.foot + pose.position + contact.along * axisZ(pose.orientation);
    reaction.force = -contact.force * contact.normal;
    reaction.limited = contact.limited;
    reaction.penetration = std::max(0.0, -contact.gap);
    reactions.push_back(reaction);
  }
}

}  // namespace vegetation_sim::forest
