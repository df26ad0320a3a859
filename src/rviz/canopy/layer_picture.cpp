// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/canopy/layer_picture.h"

#include <OgreHardwarePixelBuffer.h>
#include <OgreRenderQueue.h>
#include <OgreRenderTexture.h>
#include <OgreResourceGroupManager.h>
#include <OgreTextureManager.h>
#include <OgreViewport.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "rviz/render/texture.h"

namespace vegetation_sim::view {
namespace {

constexpr int LARGEST = 2048;        // [pixel] edge of a picture
constexpr int FIRST_PRIORITY = 101;  // beyond that of the sky
constexpr int MOST_LAYERS = 99;      // that have priorities of their own

}  // namespace

RenderedTexture::RenderedTexture(const std::string& name, int width, int height,
                                 Ogre::Camera& camera)
    : name_(name) {
  const Ogre::TexturePtr texture = Ogre::TextureManager::getSingleton().createManual(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D,
      static_cast<Ogre::uint>(width), static_cast<Ogre::uint>(height), 0, Ogre::PF_BYTE_RGBA,
      Ogre::TU_RENDERTARGET);
  Ogre::RenderTarget* target = texture->getBuffer()->getRenderTarget();
  target->setAutoUpdated(false);
  Ogre::Viewport* viewport = target->addViewport(&camera);
  viewport->setOverlaysEnabled(false);
  viewport->setSkiesEnabled(false);
  viewport->setShadowsEnabled(false);
  viewport->setBackgroundColour(Ogre::ColourValue(0.f, 0.f, 0.f, 0.f));
}

RenderedTexture::~RenderedTexture() {
  if (Ogre::TextureManager::getSingletonPtr() != nullptr)
    Ogre::TextureManager::getSingleton().remove(name_);
}

void RenderedTexture::render(bool clear) {
  const Ogre::TexturePtr texture = Ogre::TextureManager::getSingleton().getByName(name_);
  Ogre::RenderTarget* target = texture->getBuffer()->getRenderTarget();
  target->getViewport(0)->setClearEveryFrame(clear);
  target->update();
}

LayerPicture::LayerPicture(canopy::LayerGrid grid, int layer, const Vec3& origin,
                           Ogre::SceneNode& node)
    : grid_(std::move(grid)), layer_(layer), origin_(origin), node_(&node) {}

void LayerPicture::open(double pixels_per_radian, Ogre::Camera& camera) {
  const auto edge = [&](double half) {
    return std::clamp(static_cast<int>(2.0 * half * pixels_per_radian), 16, LARGEST);
  };
  const canopy::ImageFrame& frame = grid_.frame();
  texture_ = std::make_unique<RenderedTexture>(uniqueName("layer_picture"), edge(frame.half_width),
                                               edge(frame.half_height), camera);
}

void LayerPicture::render() {
  texture_->render(empty_);
  empty_ = false;
}

void LayerPicture::finish(int layers_behind) {
  material_ = std::make_unique<Material>(Material::Kind::LAYER, uniqueName("layer_material"),
                                         std::vector<std::string>{texture_->name()});
  buildBatch();
  // Back to front, after all opaque plants and the sky.
  const int priority = FIRST_PRIORITY + std::min(layers_behind, MOST_LAYERS);
  batch_->setRenderQueueGroupAndPriority(Ogre::RENDER_QUEUE_4, static_cast<Ogre::ushort>(priority));
}

// Texture coordinates are those of the nodes at rest in the picture, times their depth: so the
// picture of the grid at rest is the picture itself, whatever the depths of the nodes are.
void LayerPicture::buildBatch() {
  const canopy::ImageFrame& frame = grid_.frame();
  std::vector<VertexPaint> paint;
  for (const Vec3& node : grid_.rest()) {
    const Vec3 seen = canopy::into(frame.axes, node - frame.eye);
    const double depth = -seen.z();
    VertexPaint vertex{{0.f, 0.f, 1.f}, {255, 255, 255, 255}, {0.f, 0.f, 1.f}};
    vertex.place[0] = static_cast<float>(0.5 * (depth + seen.x() / frame.half_width));
    vertex.place[1] = static_cast<float>(0.5 * (depth - seen.y() / frame.half_height));
    vertex.place[2] = static_cast<float>(depth);
    paint.push_back(vertex);
  }
  std::vector<std::uint32_t> triangles;
  for (const auto& cell : grid_.cells())
    triangles.insert(triangles.end(), {cell[0], cell[1], cell[3], cell[0], cell[3], cell[2]});
  positions_.assign(3 * paint.size(), 0.f);
  for (std::size_t i = 0; i < paint.size(); ++i)
    for (int k = 0; k < 3; ++k)
      positions_[3 * i + static_cast<std::size_t>(k)] =
          static_cast<float>(grid_.moved()[i][k] - origin_[k]);
  batch_ = std::make_unique<Batch>(uniqueName("layer_grid"), material_->name());
  batch_->build(positions_, paint, triangles, 1.f);
  node_->attachObject(batch_.get());
}

void LayerPicture::move(const canopy::Foliage& foliage) {
  grid_.move(foliage);
  if (!batch_) return;
  float* out = positions_.data();
  for (const Vec3& node : grid_.moved())
    for (int k = 0; k < 3; ++k) *out++ = static_cast<float>(node[k] - origin_[k]);
  batch_->move(positions_);
}

}  // namespace vegetation_sim::view
