// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/robot_shadows.h"

#include <OgreEntity.h>
#include <OgreSceneManager.h>
#include <OgreSubEntity.h>
#include <OgreTechnique.h>
#include <rviz/display_context.h>
#include <rviz/display_group.h>

#include <utility>

#include "rviz/render/ogre_vectors.h"
#include "rviz/trees/shared_light.h"

namespace vegetation_sim::view {
namespace {

constexpr std::size_t MOST_BOXES = 200;
constexpr double SMALLEST_BOX = 0.015;  // [m] longest half side of what casts a shadow
constexpr double CONTACT_DARK = 0.7, SUN_DARK = 0.55;

bool castsShadows(const Ogre::Entity& entity) {
  if (!entity.isVisible() || entity.getNumSubEntities() == 0) return false;
  const Ogre::MaterialPtr& material =
      const_cast<Ogre::Entity&>(entity).getSubEntity(0)->getMaterial();
  return !material->isTransparent();
}

// Returns the bounding box of an object, whose axes turn with it, in the frame of a node.
ShadowBox boxOf(Ogre::Entity& entity, Ogre::SceneNode& node) {
  const Ogre::AxisAlignedBox& box = entity.getBoundingBox();
  const Ogre::Node& own = *entity.getParentNode();
  const auto place = [&](const Ogre::Vector3& local) {
    return toVec3(node.convertWorldToLocalPosition(
        const_cast<Ogre::Node&>(own).convertLocalToWorldPosition(local)));
  };
  ShadowBox out;
  const Ogre::Vector3 middle = box.getCenter(), half = box.getHalfSize();
  out.centre = place(middle);
  const Ogre::Vector3 sides[] = {{half.x, 0.f, 0.f}, {0.f, half.y, 0.f}, {0.f, 0.f, half.z}};
  for (std::size_t i = 0; i < 3; ++i) out.half[i] = place(middle + sides[i]) - out.centre;
  return out;
}

void collectBoxes(Ogre::SceneNode& from, Ogre::SceneNode& node, std::vector<ShadowBox>& out) {
  for (unsigned short i = 0; i < from.numAttachedObjects() && out.size() < MOST_BOXES; ++i) {
    auto* entity = dynamic_cast<Ogre::Entity*>(from.getAttachedObject(i));
    if (entity != nullptr && castsShadows(*entity) && entity->getBoundingBox().isFinite())
      out.push_back(boxOf(*entity, node));
  }
  for (unsigned short i = 0; i < from.numChildren(); ++i)
    if (auto* child = dynamic_cast<Ogre::SceneNode*>(from.getChild(i)))
      collectBoxes(*child, node, out);
}

void collectBoxes(const rviz::DisplayGroup& group, Ogre::SceneNode& node,
                  std::vector<ShadowBox>& out) {
  for (int i = 0; i < group.numDisplays(); ++i) {
    rviz::Display* display = group.getDisplayAt(i);
    if (!display->isEnabled()) continue;
    if (const rviz::DisplayGroup* inner = group.getGroupAt(i)) collectBoxes(*inner, node, out);
    const QString kind = display->getClassId();
    if (kind != "rviz/RobotModel" && kind != "rviz/Marker" && kind != "rviz/MarkerArray") continue;
    Ogre::SceneNode& shown = *display->getSceneNode();
    shown._update(true, false);  // Otherwise, places inside would be those of the last frame.
    collectBoxes(shown, node, out);
  }
}

}  // namespace

void RobotShadows::update(rviz::DisplayContext& context, const std::string& frame,
                          const terrain::HeightMap& terrain, const Daylight& daylight,
                          const Haze& haze) {
  std::vector<ShadowBox> boxes;
  collectBoxes(*context.getRootDisplayGroup(), node_, boxes);
  std::vector<BlobShadow> shadows;
  const auto add = [&](const std::optional<BlobShadow>& shadow) {
    if (shadow) shadows.push_back(*shadow);
  };
  for (const ShadowBox& box : boxes) {
    double size = 0.0;
    for (const Vec3& half : box.half) size = std::max(size, length(half));
    if (size < SMALLEST_BOX) continue;
    const SharedLight::Shares light = SharedLight::at(node_.getCreator(), frame, box.centre);
    add(contactShadow(box, CONTACT_DARK, terrain));
    add(sunShadow(box, daylight.to_sun, SUN_DARK * light.sun, terrain));
  }
  blobs_.light(daylight, haze);
  blobs_.fill(std::move(shadows), frame, terrain);
}

}  // namespace vegetation_sim::view
