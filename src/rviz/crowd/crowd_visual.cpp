// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/crowd/crowd_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rviz/crowd/body_mesh.h"
#include "rviz/render/batch.h"
#include "rviz/textures/shadow_texture.h"
#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr double STILL = 1e-4;      // [m], [rad] a viewer moves without effect
constexpr double LIFT = 0.02;       // [m] of shadows over the ground
constexpr double LONGEST = 2.5;     // length of a shadow in heights
constexpr std::uint8_t DARK = 175;  // alpha of a shadow
// Strengths of contact shadows below feet and bodies, and of a body's shadow on grass.
constexpr double FOOT_DARK = 0.75, BODY_DARK = 0.5, GRASS_DARK = 0.6;

Vec3 placeOf(const SubscribedCrowd::Person& person) {
  return {person.walker.position.x, person.walker.position.y, person.ground};
}

}  // namespace

CrowdVisual::CrowdVisual(Ogre::SceneNode& parent)
    : node_(parent.createChildSceneNode()),
      shadow_texture_(uniqueName("shadow_picture"), mipmaps(shadowPicture())),
      body_material_(Material::Kind::BLADES, uniqueName("body_material"), {}),
      shadow_material_(Material::Kind::SHADOWS, uniqueName("shadow_material"),
                       {shadow_texture_.name()}),
      bodies_(uniqueName("bodies"), body_material_.name(), 0),
      shadows_(uniqueName("shadows"), shadow_material_.name(), Batch::LAST_RANK + 1),
      contacts_(parent) {
  node_->attachObject(&bodies_);
  node_->attachObject(&shadows_);
}

CrowdVisual::~CrowdVisual() {
  node_->detachAllObjects();
  node_->getCreator()->destroySceneNode(node_);
}

void CrowdVisual::light(const Daylight& daylight, const Haze& haze) {
  daylight_ = daylight;
  body_material_.light(daylight, daylight.to_sun, haze);
  shadow_material_.light(daylight, daylight.to_sun, haze);
  contacts_.light(daylight, haze);
  repaint();
}

// Returns the nearest people in the picture.
std::vector<const SubscribedCrowd::Person*> CrowdVisual::select(const SubscribedCrowd& crowd,
                                                                const View& view,
                                                                std::size_t most) const {
  std::vector<const Person*> out;
  for (const Person& person : crowd.people()) {
    const Vec3 middle = placeOf(person) + Vec3(0.0, 0.0, 0.5 * person.walker.height);
    if (view.sees(middle, 2.0 * person.walker.height)) out.push_back(&person);
  }
  std::sort(out.begin(), out.end(), [&](const Person* a, const Person* b) {
    return (placeOf(*a) - view.eye.position).squaredNorm() <
           (placeOf(*b) - view.eye.position).squaredNorm();
  });
  if (out.size() > most) out.resize(most);
  return out;
}

void CrowdVisual::update(const SubscribedCrowd& crowd, Nanoseconds stamp,
                         const terrain::HeightMap& terrain, const View& view,
                         const Options& options) {
  if (drawn_ == crowd.changes() && stamp_ == stamp && length(eye_ - view.eye.position) < STILL &&
      length(forward_ - view.forward) < STILL)
    return;
  drawn_ = crowd.changes();
  stamp_ = stamp;
  frame_ = crowd.frame();
  eye_ = view.eye.position;
  forward_ = view.forward;
  body_mesh_.clear();
  shadow_mesh_.clear();
  blobs_.clear();
  // Positions are relative to the first person: floats are exact enough far from the world origin.
  const Vec3 origin = crowd.people().empty() ? Vec3(Vec3::Zero()) : placeOf(crowd.people().front());
  body_mesh_.origin = shadow_mesh_.origin = origin;
  node_->setPosition(static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                     static_cast<float>(origin.z()));
  const std::vector<const Person*> people = select(crowd, view, options.most_people);
  const double since = secondsBetween(crowd.stamp(), stamp);
  for (const Person* person : people)
    addPerson(extrapolatePerson(*person, terrain, since), crowd, terrain, view, options);
  bodies_.fill(body_mesh_);
  shadows_.fill(shadow_mesh_);
  contacts_.fill(std::move(blobs_), frame_, terrain);
  report_.people = crowd.people().size();
  report_.drawn = people.size();
  report_.triangles =
      (body_mesh_.indices.size() + shadow_mesh_.indices.size()) / 3 + contacts_.triangleCount();
  ++report_.rebuilds;
}

// The message gives the height of the ground, which may differ from the terrain known here.
CrowdVisual::Person CrowdVisual::extrapolatePerson(const Person& person,
                                                   const terrain::HeightMap& terrain,
                                                   double seconds) {
  const auto heightBelow = [&](const crowd::Walker& walker) {
    return terrain.height(walker.position.x, walker.position.y);
  };
  Person out = person;
  out.walker = walkOn(person.walker, seconds);
  out.ground += heightBelow(out.walker) - heightBelow(person.walker);
  return out;
}

void CrowdVisual::addPerson(const Person& person, const SubscribedCrowd& crowd,
                            const terrain::HeightMap& terrain, const View& view,
                            const Options& options) {
  const crowd::Walker& walker = person.walker;
  crowd::Skeleton skeleton =
      skeletonOf(walker, terrain, crowd.motions(), secondsBetween(0, stamp_));
  const double rise = person.ground - terrain.height(walker.position.x, walker.position.y);
  for (crowd::Limb& limb : skeleton) {
    limb.from.z() += rise;
    limb.to.z() += rise;
  }
  const double distance = length(placeOf(person) - view.eye.position);
  BodyStyle style = bodyStyle(static_cast<double>(options.detail) * walker.height *
                              pixelsPerMetre(view.eye, distance));
  const SinCos heading = sinCos(walker.heading);
  style.left_x = -heading.sin;
  style.left_y = heading.cos;
  const auto light = [&](const Vec3& place) {
    return SharedLight::at(node_->getCreator(), frame_, place);
  };
  appendBody(skeleton, crowd::clothesOf(walker.id), style, daylight_, light, body_mesh_);
  if (options.shadows) addShadow(person, terrain, skeleton);
  if (options.contact_shadows) addContacts(person, terrain, skeleton, options);
}

// Adds the shadows below the feet and the body, and for the grass that of the body in sunlight. The
// terrain known here may differ from that of the message.
void CrowdVisual::addContacts(const Person& person, const terrain::HeightMap& terrain,
                              const crowd::Skeleton& skeleton, const Options& options) {
  const double rise =
      person.ground - terrain.height(person.walker.position.x, person.walker.position.y);
  const auto add = [&](const std::optional<BlobShadow>& shadow) {
    if (!shadow) return;
    blobs_.push_back(*shadow);
    blobs_.back().centre.z() += rise;
  };
  const auto box = [&](crowd::Part part, int side) {
    const crowd::Limb& limb = limbOf(skeleton, part, side);
    ShadowBox out = capsuleBox(limb.from, limb.to, limb.radius);
    out.centre.z() -= rise;
    return out;
  };
  for (int side = 0; side < 2; ++side)
    add(contactShadow(box(crowd::Part::FOOT, side), FOOT_DARK, terrain));
  const double height = person.walker.height;
  const Vec3 foot(person.walker.position.x, person.walker.position.y, person.ground - rise);
  add(contactShadow(capsuleBox(foot, foot, 0.18 * height), BODY_DARK, terrain));
  if (!options.shadows) return;
  const Vec3 top = foot + Vec3(0.0, 0.0, 0.9 * height);
  std::optional<BlobShadow> body =
      sunShadow(capsuleBox(foot, top, 0.08 * height), daylight_.to_sun, GRASS_DARK, terrain);
  if (body) body->on_ground = false;
  add(body);
}

// Adds a quad with a soft texture from the feet away from the sun.
void CrowdVisual::addShadow(const Person& person, const terrain::HeightMap& terrain,
                            const crowd::Skeleton& skeleton) {
  const Vec3& sun = daylight_.to_sun;
  const double flat = std::max(1e-6, std::hypot(sun.x(), sun.y()));
  const Vec3 away(-sun.x() / flat, -sun.y() / flat, 0.0), across(-away.y(), away.x(), 0.0);
  const double height = person.walker.height;
  const double reach = height * std::min(LONGEST, flat / std::max(0.1, sun.z()));
  const Vec3 foot = 0.5 * (limbOf(skeleton, crowd::Part::FOOT, 0).from +
                           limbOf(skeleton, crowd::Part::FOOT, 1).from);
  const double wide = 0.19 * height;
  const auto first = static_cast<std::uint32_t>(shadow_mesh_.vertexCount());
  for (int i = 0; i < 4; ++i) {
    const double v = i / 2, u = i % 2;
    Vec3 at = foot + (-0.2 * height + v * (reach + 0.3 * height)) * away +
              wide * (2.0 * u - 1.0) * across;
    const double rise = terrain.height(at.x(), at.y()) -
                        terrain.height(person.walker.position.x, person.walker.position.y);
    at.z() = person.ground + rise + LIFT;
    const Vec3 local = at - shadow_mesh_.origin;
    for (int k = 0; k < 3; ++k) shadow_mesh_.positions.push_back(static_cast<float>(local[k]));
    shadow_mesh_.texture.insert(shadow_mesh_.texture.end(),
                                {static_cast<float>(u), static_cast<float>(v)});
    shadow_mesh_.colours.insert(shadow_mesh_.colours.end(), {18, 22, 14, DARK});
  }
  shadow_mesh_.indices.insert(shadow_mesh_.indices.end(),
                              {first, first + 1, first + 3, first, first + 3, first + 2});
}

}  // namespace vegetation_sim::view
