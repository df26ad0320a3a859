// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/render/material.h"

// Must stand before Ogre's material headers, which only declare it.
#include <OgreHighLevelGpuProgram.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgreTechnique.h>

#include <algorithm>

#include "rviz/render/shaders.h"

namespace vegetation_sim::view {
namespace {

const char* const GROUP = "General";  // Ogre's default resource group
constexpr float EDGE_SINE = 0.35f;    // of the angle to the view at which near leaves begin to go
constexpr float NEAR_START = 6.f;     // [m] beyond which this angle becomes less

Ogre::HighLevelGpuProgramPtr makeProgram(const std::string& name, const std::string& source,
                                         Ogre::GpuProgramType type) {
  Ogre::HighLevelGpuProgramPtr program =
      Ogre::HighLevelGpuProgramManager::getSingleton().createProgram(name, GROUP, "glsl", type);
  program->setSource(source);
  return program;
}

void bindCamera(Ogre::GpuProgramParameters& parameters, Material::Kind kind,
                Material::Variant variant) {
  parameters.setNamedAutoConstant("world_view_projection",
                                  Ogre::GpuProgramParameters::ACT_WORLDVIEWPROJ_MATRIX);
  if (kind == Material::Kind::LAYER) return;
  if (variant == Material::Variant::LAYERED) {
    parameters.setNamedAutoConstant("world", Ogre::GpuProgramParameters::ACT_WORLD_MATRIX);
    parameters.setNamedAutoConstant("eye", Ogre::GpuProgramParameters::ACT_CAMERA_POSITION);
    return;
  }
  parameters.setNamedAutoConstant("eye",
                                  Ogre::GpuProgramParameters::ACT_CAMERA_POSITION_OBJECT_SPACE);
}

bool hasTwoSides(Material::Kind kind) {
  return kind != Material::Kind::BARK && kind != Material::Kind::GROUND;
}

struct Sources {
  const char *vertex, *fragment;
};
Sources sourcesOf(Material::Kind kind) {
  switch (kind) {
    case Material::Kind::GROUND:
      return {GROUND_VERTEX, GROUND_FRAGMENT};
    case Material::Kind::BLADES:
      return {GRASS_VERTEX, BLADE_FRAGMENT};
    case Material::Kind::STRIPS:
      return {GRASS_VERTEX, STRIP_FRAGMENT};
    case Material::Kind::SHADOWS:
      return {GRASS_VERTEX, SHADOW_FRAGMENT};
    case Material::Kind::LAYER:
      return {LAYER_VERTEX, LAYER_FRAGMENT};
    default:
      return {PLANT_VERTEX, PLANT_FRAGMENT};
  }
}

// Draws over what lies just below it and writes no depth.
void makeShadow(Ogre::Pass& pass) {
  pass.setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass.setDepthWriteEnabled(false);
  pass.setDepthBias(2.f, 2.f);
}

// Draws colours that are multiplied by their alpha, over what is behind.
void makeLayer(Ogre::Pass& pass) {
  pass.setSceneBlending(Ogre::SBF_ONE, Ogre::SBF_ONE_MINUS_SOURCE_ALPHA);
}

const char* headOf(Material::Variant variant) {
  if (variant == Material::Variant::FADING) return FADING_HEAD;
  if (variant == Material::Variant::NEAR) return NEAR_HEAD;
  return variant == Material::Variant::LAYERED ? LAYERED_HEAD : HEAD;
}

Ogre::Vector4 narrow(const Rgba& c) {
  return {c[0], c[1], c[2], c[3]};
}

}  // namespace

Material::Material(Kind kind, const std::string& name, const std::vector<std::string>& textures,
                   Variant variant)
    : kind_(kind), variant_(variant), name_(name) {
  material_ = Ogre::MaterialManager::getSingleton().create(name, GROUP);
  material_->setReceiveShadows(false);
  material_->removeAllTechniques();
  if (kind != Kind::SKY) addShaded(textures);
  addPlain(textures);
  material_->load();
}

Material::~Material() {
  material_ = Ogre::MaterialPtr();
  if (Ogre::MaterialManager::getSingletonPtr() == nullptr) return;
  Ogre::MaterialManager::getSingleton().remove(name_);
  for (const std::string& program : programs_)
    Ogre::HighLevelGpuProgramManager::getSingleton().remove(program);
}

void Material::addTextures(Ogre::Pass& pass, const std::vector<std::string>& textures) const {
  for (const std::string& texture : textures) {
    Ogre::TextureUnitState* unit = pass.createTextureUnitState(texture);
    const bool repeats = kind_ == Kind::BARK || kind_ == Kind::SKY || kind_ == Kind::STRIPS ||
                         unit != pass.getTextureUnitState(0);
    unit->setTextureAddressingMode(repeats ? Ogre::TextureUnitState::TAM_WRAP
                                           : Ogre::TextureUnitState::TAM_CLAMP);
    if (kind_ == Kind::LEAVES) unit->setTextureMipmapBias(-0.7f);  // keeps leaf outlines crisp
    if (kind_ == Kind::GROUND && unit != pass.getTextureUnitState(0))
      unit->setTextureMipmapBias(-1.2f);  // keeps the grain visible at low angles
    unit->setTextureFiltering(Ogre::FO_LINEAR, Ogre::FO_LINEAR, Ogre::FO_POINT);
  }
}

void Material::addShaded(const std::vector<std::string>& textures) {
  programs_ = {name_ + "/vertex", name_ + "/fragment"};
  const Sources sources = sourcesOf(kind_);
  const std::string head = headOf(variant_);
  const auto vertex = makeProgram(programs_[0], head + sources.vertex, Ogre::GPT_VERTEX_PROGRAM);
  const auto fragment =
      makeProgram(programs_[1], head + sources.fragment, Ogre::GPT_FRAGMENT_PROGRAM);
  Ogre::Pass* pass = material_->createTechnique()->createPass();
  pass->setVertexProgram(programs_[0]);
  pass->setFragmentProgram(programs_[1]);
  pass->setFog(true, Ogre::FOG_NONE);  // the shaders add haze
  bindCamera(*pass->getVertexProgramParameters(), kind_, variant_);
  if (kind_ != Kind::BLADES) pass->getFragmentProgramParameters()->setNamedConstant("picture", 0);
  if (kind_ == Kind::GROUND) {
    pass->getFragmentProgramParameters()->setNamedConstant("grain", 1);
    darken(0.f);
  }
  if (kind_ == Kind::LEAVES) pass->setAlphaRejectSettings(Ogre::CMPF_GREATER_EQUAL, 128);
  if (hasTwoSides(kind_)) pass->setCullingMode(Ogre::CULL_NONE);
  if (kind_ == Kind::SHADOWS) makeShadow(*pass);
  if (kind_ == Kind::LAYER) {
    makeLayer(*pass);
    show(1.f);
  }
  addTextures(*pass, textures);
}

void Material::addPlain(const std::vector<std::string>& textures) {
  Ogre::Pass* pass = material_->createTechnique()->createPass();
  const bool plant = kind_ == Kind::BARK || kind_ == Kind::LEAVES;
  pass->setLightingEnabled(plant);
  if (plant) {
    pass->setVertexColourTracking(Ogre::TVC_AMBIENT | Ogre::TVC_DIFFUSE);
    pass->setSpecular(0.f, 0.f, 0.f, 0.f);
  }
  if (kind_ == Kind::LEAVES) pass->setAlphaRejectSettings(Ogre::CMPF_GREATER_EQUAL, 128);
  if (kind_ == Kind::STRIPS) pass->setAlphaRejectSettings(Ogre::CMPF_GREATER, 127);
  if (hasTwoSides(kind_)) pass->setCullingMode(Ogre::CULL_NONE);
  if (kind_ == Kind::SHADOWS) makeShadow(*pass);
  if (kind_ == Kind::LAYER) makeLayer(*pass);
  if (kind_ == Kind::SKY) {
    pass->setFog(true, Ogre::FOG_NONE);
    pass->setDepthWriteEnabled(false);
  }
  if (!textures.empty()) addTextures(*pass, {textures.front()});
  if (plant)  // vertex alpha is not transparency
    pass->getTextureUnitState(0)->setAlphaOperation(Ogre::LBX_SOURCE1, Ogre::LBS_TEXTURE,
                                                    Ogre::LBS_CURRENT);
  if (kind_ == Kind::STRIPS) {  // visible where texture + vertex > 1, as in STRIP_FRAGMENT
    Ogre::TextureUnitState& unit = *pass->getTextureUnitState(0);
    unit.setAlphaOperation(Ogre::LBX_ADD_SIGNED, Ogre::LBS_TEXTURE, Ogre::LBS_CURRENT);
    unit.setColourOperationEx(Ogre::LBX_SOURCE1, Ogre::LBS_CURRENT);  // brighter
  }
}

void Material::light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze) {
  if (kind_ == Kind::SKY || kind_ == Kind::LAYER) return;
  Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
  Ogre::GpuProgramParameters& vertex = *pass->getVertexProgramParameters();
  const float length = std::max(haze.end - haze.start, 1.f);
  vertex.setNamedConstant("haze", Ogre::Vector4(haze.start, 1.f / length, haze.most, 0.f));
  pass->getFragmentProgramParameters()->setNamedConstant("haze_colour", narrow(daylight.horizon));
  if (kind_ != Kind::BARK && kind_ != Kind::LEAVES) return;
  vertex.setNamedConstant(
      "to_sun", Ogre::Vector4(static_cast<float>(to_sun.x()), static_cast<float>(to_sun.y()),
                              static_cast<float>(to_sun.z()), 0.f));
  vertex.setNamedConstant("sun", narrow(daylight.sun));
  vertex.setNamedConstant("zenith_light", narrow(daylight.zenith_light));
  vertex.setNamedConstant("ground_light", narrow(daylight.ground_light));
  const bool leaves = kind_ == Kind::LEAVES;
  vertex.setNamedConstant("leaf", leaves ? Ogre::Vector4(0.5f, 0.8f, 0.75f, 0.14f)
                                         : Ogre::Vector4(0.15f, 0.f, 0.55f, 0.f));
  if (variant_ == Variant::NEAR || variant_ == Variant::FADING)
    vertex.setNamedConstant("edges", Ogre::Vector4(leaves ? EDGE_SINE : 0.f, NEAR_START,
                                                   1.f / (NEAR_END - NEAR_START), 0.f));
}

void Material::setFadeClock(float clock) {
  material_->getTechnique(0)->getPass(0)->getVertexProgramParameters()->setNamedConstant(
      "fade_clock", Ogre::Vector4(clock, 0.f, 0.f, 0.f));
}

void Material::setLayer(const Vec3& axis, double depth, const std::array<double, 2>& depths) {
  Ogre::GpuProgramParameters& vertex =
      *material_->getTechnique(0)->getPass(0)->getVertexProgramParameters();
  const auto narrowed = [](double value) {
    return static_cast<float>(std::clamp(value, -1e30, 1e30));
  };
  vertex.setNamedConstant("depth_axis", Ogre::Vector4(narrowed(axis.x()), narrowed(axis.y()),
                                                      narrowed(axis.z()), narrowed(depth)));
  vertex.setNamedConstant("depths",
                          Ogre::Vector4(narrowed(depths[0]), narrowed(depths[1]), 0.f, 0.f));
}

void Material::show(float part) {
  material_->getTechnique(0)->getPass(0)->getFragmentProgramParameters()->setNamedConstant(
      "shown", Ogre::Vector4(part, 0.f, 0.f, 0.f));
}

void Material::darken(float distance) {
  material_->getTechnique(0)->getPass(0)->getFragmentProgramParameters()->setNamedConstant(
      "under", Ogre::Vector4(1.f / std::max(distance * distance, 1e-6f), 0.f, 0.f, 0.f));
}

}  // namespace vegetation_sim::view
