// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/leaves_at_rest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rviz/render/ogre_vectors.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {
LeavesAtRest::LeavesAtRest(Ogre::SceneManager& scene, const canopy::Layout& layout,
                           const Vec3& origin, const std::string& material,
                           const PlantTextures& textures, const Vec3& to_sun)
    : scene_(&scene),
      hidden_(scene.createSceneNode()),
      layout_(layout),
      origin_(origin),
      material_(material),
      textures_(textures),
      to_sun_(to_sun) {}

LeavesAtRest::~LeavesAtRest() {
  drop();
  forms_.clear();
  scene_->destroySceneNode(hidden_);
}

void LeavesAtRest::remove(Rest& rest) {
  for (Instance& instance : rest.instances) {
    instance.batch.reset();
    scene_->destroySceneNode(instance.node);
  }
}

void LeavesAtRest::drop() {
  for (Rest& rest : rest_) remove(rest);
  rest_.clear();
}

bool LeavesAtRest::choose(const std::vector<const CanopyPatch*>& patches) {
  const auto isSame = [](const Rest& rest, const CanopyPatch* patch) {
    return rest.patch == patch;
  };
  if (std::equal(rest_.begin(), rest_.end(), patches.begin(), patches.end(), isSame)) return false;
  std::map<const CanopyPatch*, Rest> known;
  for (Rest& rest : rest_) known[rest.patch] = std::move(rest);
  rest_.clear();
  for (const CanopyPatch* patch : patches) {
    const auto found = known.find(patch);
    rest_.push_back(found == known.end() ? restOf(*patch) : std::move(found->second));
    if (found != known.end()) known.erase(found);
  }
  for (auto& gone : known) remove(gone.second);
  return true;
}

LeavesAtRest::Rest LeavesAtRest::restOf(const CanopyPatch& patch) {
  Rest out{&patch, nullptr, {}};
  if (patch.leafCount(CanopyPatch::Share::OTHERS) > 0)
    out.batch =
        patch.copyAtRest(*scene_->getRootSceneNode(), material_, CanopyPatch::Share::OTHERS);
  for (const std::size_t plant : patch.alike()) out.instances.push_back(instanceOf(plant));
  return out;
}

const LeavesAtRest::Form& LeavesAtRest::formOf(std::size_t kind) {
  Form& out = forms_[kind];
  if (out.batch) return out;
  out.layout = std::make_unique<canopy::Layout>();
  out.layout->kinds = layout_.kinds;
  out.layout->plants.resize(1);
  out.layout->plants[0].kind = static_cast<std::uint16_t>(kind);
  out.plant = std::make_unique<CanopyPatch>(
      *out.layout, std::vector<std::size_t>{0}, std::vector<double>{canopy::UNCUT},
      PatchScene{Vec3::Zero(), hidden_, material_, material_, to_sun_, &textures_, {}});
  out.batch = out.plant->copyAtRest(*hidden_, material_, CanopyPatch::Share::ALIKE);
  return out;
}

LeavesAtRest::Instance LeavesAtRest::instanceOf(std::size_t plant) {
  const canopy::Plant& p = layout_.plants[plant];
  Instance out{plant, std::make_unique<Batch>(uniqueName("plant_at_rest"), material_),
               scene_->getRootSceneNode()->createChildSceneNode()};
  out.batch->share(*formOf(p.kind).batch);
  const auto scale = static_cast<float>(p.scale);
  out.node->setPosition(toOgre(p.position - origin_));
  out.node->setOrientation(
      Ogre::Quaternion(Ogre::Radian(static_cast<float>(p.yaw)), Ogre::Vector3::UNIT_Z));
  out.node->setScale(scale, scale, scale);
  out.node->attachObject(out.batch.get());
  return out;
}

std::size_t LeavesAtRest::leafCount() const {
  std::size_t out = 0;
  for (const Rest& rest : rest_) {
    out += rest.patch->leafCount(CanopyPatch::Share::OTHERS);
    for (const Instance& instance : rest.instances)
      out += forms_.at(layout_.plants[instance.plant].kind).plant->leafCount();
  }
  return out;
}

std::vector<LeavesAtRest::Part> LeavesAtRest::parts() const {
  std::vector<Part> out;
  for (const Rest& rest : rest_) {
    if (rest.batch)
      out.push_back({rest.batch.get(), rest.patch->middle(), rest.patch->reach(), 0.0});
    for (const Instance& instance : rest.instances) {
      const canopy::Plant& plant = layout_.plants[instance.plant];
      const canopy::PlantKind& kind = layout_.kinds[plant.kind];
      const double height = plant.scale * kind.height;
      const double radius = plant.scale * kind.height * (kind.form ? kind.form->radius : 1.0);
      out.push_back({instance.batch.get(), plant.position + Vec3(0.0, 0.0, 0.5 * height),
                     std::hypot(radius, 0.5 * height), 2.0 * radius * height});
    }
  }
  return out;
}

}  // namespace vegetation_sim::view
