// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/render/grass_batch.h"

#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreMaterialManager.h>
#include <OgreNode.h>
#include <OgreRenderQueue.h>

#include "rviz/render/drawing.h"

namespace vegetation_sim::view {
namespace {

constexpr unsigned short POSITIONS = 0, TEXTURE = 1, COLOURS = 2;  // streams
constexpr std::size_t LEAST_ROOM = 4096;  // smallest capacity in vertices or indices

// A quarter is added, so that a slowly growing mesh is rarely reallocated.
std::size_t roomFor(std::size_t wanted) {
  return std::max(LEAST_ROOM, wanted + wanted / 4);
}

}  // namespace

GrassBatch::GrassBatch(const std::string& name, const std::string& material, int rank)
    : Ogre::SimpleRenderable(name) {
  // OGRE 1.9 and 1.12 have no overload of setMaterial() in common.
  mMaterial = Ogre::MaterialManager::getSingleton().getByName(material);
  mMaterial->load();
  setCastShadows(false);
  setRenderQueueGroupAndPriority(Ogre::RENDER_QUEUE_3, static_cast<Ogre::ushort>(rank));
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  mRenderOp.vertexData = new Ogre::VertexData();
  mRenderOp.indexData = new Ogre::IndexData();
  mRenderOp.indexData->indexCount = 0;
  Ogre::VertexDeclaration& declaration = *mRenderOp.vertexData->vertexDeclaration;
  declaration.addElement(POSITIONS, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  declaration.addElement(TEXTURE, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES);
  declaration.addElement(COLOURS, 0, Ogre::VET_COLOUR_ABGR, Ogre::VES_DIFFUSE);
}

GrassBatch::~GrassBatch() {
  delete mRenderOp.vertexData;  // the structure of OGRE holds raw pointers
  delete mRenderOp.indexData;
}

void GrassBatch::makeRoom(std::size_t vertices, std::size_t indices) {
  Ogre::HardwareBufferManager& manager = Ogre::HardwareBufferManager::getSingleton();
  const auto usage = Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE;
  if (vertices > vertex_room_) {
    vertex_room_ = roomFor(vertices);
    positions_ = manager.createVertexBuffer(3 * sizeof(float), vertex_room_, usage);
    texture_ = manager.createVertexBuffer(2 * sizeof(float), vertex_room_, usage);
    colours_ = manager.createVertexBuffer(4, vertex_room_, usage);
    Ogre::VertexBufferBinding& binding = *mRenderOp.vertexData->vertexBufferBinding;
    binding.setBinding(POSITIONS, positions_);
    binding.setBinding(TEXTURE, texture_);
    binding.setBinding(COLOURS, colours_);
  }
  if (indices > index_room_) {
    index_room_ = roomFor(indices);
    indices_ = manager.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, index_room_, usage);
    mRenderOp.indexData->indexBuffer = indices_;
  }
}

void GrassBatch::fill(const grass::GrassMesh& mesh) {
  const std::size_t vertices = mesh.vertexCount();
  mRenderOp.indexData->indexCount = mesh.indices.size();
  mRenderOp.vertexData->vertexCount = vertices;
  if (mesh.indices.empty()) return setBoundingBox(Ogre::AxisAlignedBox());
  makeRoom(vertices, mesh.indices.size());
  positions_->writeData(0, 3 * sizeof(float) * vertices, mesh.positions.data(), true);
  texture_->writeData(0, 2 * sizeof(float) * vertices, mesh.texture.data(), true);
  colours_->writeData(0, 4 * vertices, mesh.colours.data(), true);
  indices_->writeData(0, 4 * mesh.indices.size(), mesh.indices.data(), true);
  Ogre::Vector3 low(mesh.positions[0], mesh.positions[1], mesh.positions[2]), high = low;
  for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    const Ogre::Vector3 p(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    low.makeFloor(p);
    high.makeCeil(p);
  }
  setBoundingBox(Ogre::AxisAlignedBox(low, high));
  if (getParentNode() != nullptr) getParentNode()->needUpdate();
}

void GrassBatch::_updateRenderQueue(Ogre::RenderQueue* queue) {
  if (mRenderOp.indexData->indexCount > 0) Ogre::SimpleRenderable::_updateRenderQueue(queue);
}

void GrassBatch::postRender(Ogre::SceneManager* /*scene*/, Ogre::RenderSystem* /*renderer*/) {
  drew(mRenderOp.indexData->indexCount / 3);
}

Ogre::Real GrassBatch::getBoundingRadius() const {
  return mBox.isFinite() ? 0.5f * mBox.getSize().length() + mBox.getCenter().length() : 0.f;
}

Ogre::Real GrassBatch::getSquaredViewDepth(const Ogre::Camera* camera) const {
  return mBox.isFinite() ? (camera->getDerivedPosition() - mBox.getCenter()).squaredLength() : 0.f;
}

}  // namespace vegetation_sim::view
