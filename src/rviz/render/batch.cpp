// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/render/batch.h"

#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreMaterialManager.h>
#include <OgreNode.h>
#include <OgreRenderQueue.h>

#include <algorithm>

#include "rviz/render/drawing.h"

namespace vegetation_sim::view {
namespace {

constexpr unsigned short POSITION_STREAM = 0, PAINT_STREAM = 1, ANCHOR_STREAM = 2;
constexpr std::size_t LARGEST_SHORT_INDEX = 65535;

void declareVertices(Ogre::VertexDeclaration& declaration) {
  declaration.addElement(POSITION_STREAM, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  declaration.addElement(PAINT_STREAM, 0, Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
  declaration.addElement(PAINT_STREAM, 12, Ogre::VET_COLOUR_ABGR, Ogre::VES_DIFFUSE);
  declaration.addElement(PAINT_STREAM, 16, Ogre::VET_FLOAT3, Ogre::VES_TEXTURE_COORDINATES);
  // Only three components: a fixed-function technique would divide by a fourth.
  declaration.addElement(PAINT_STREAM, 28, Ogre::VET_FLOAT1, Ogre::VES_TEXTURE_COORDINATES, 1);
}

Ogre::HardwareIndexBufferSharedPtr indexBuffer(const std::vector<std::uint32_t>& triangles,
                                               std::size_t vertices) {
  Ogre::HardwareBufferManager& manager = Ogre::HardwareBufferManager::getSingleton();
  const auto usage = Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY;
  if (vertices > LARGEST_SHORT_INDEX) {
    const auto buffer =
        manager.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, triangles.size(), usage);
    buffer->writeData(0, 4 * triangles.size(), triangles.data(), true);
    return buffer;
  }
  const std::vector<std::uint16_t> narrow(triangles.begin(), triangles.end());
  const auto buffer =
      manager.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_16BIT, narrow.size(), usage);
  buffer->writeData(0, 2 * narrow.size(), narrow.data(), true);
  return buffer;
}

}  // namespace

Batch::Batch(const std::string& name, const std::string& material) : Ogre::SimpleRenderable(name) {
  wear(material);
  setCastShadows(false);
}

void Batch::wear(const std::string& material) {
  // OGRE 1.9 and 1.12 have no overload of setMaterial() in common.
  mMaterial = Ogre::MaterialManager::getSingleton().getByName(material);
  mMaterial->load();
}

Batch::~Batch() {
  clear();
}

void Batch::clear() {
  delete mRenderOp.vertexData;  // Ogre keeps it as a raw pointer
  delete mRenderOp.indexData;
  mRenderOp.vertexData = nullptr;
  mRenderOp.indexData = nullptr;
  positions_ = paint_ = anchors_ = Ogre::HardwareVertexBufferSharedPtr();
}

void Batch::build(const std::vector<float>& positions, const std::vector<VertexPaint>& paint,
                  const std::vector<std::uint32_t>& triangles, float margin) {
  clear();
  if (triangles.empty()) return setBoundingBox(Ogre::AxisAlignedBox());
  Ogre::HardwareBufferManager& manager = Ogre::HardwareBufferManager::getSingleton();
  positions_ = manager.createVertexBuffer(3 * sizeof(float), paint.size(),
                                          Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  paint_ = manager.createVertexBuffer(sizeof(VertexPaint), paint.size(),
                                      Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  move(positions);
  this->paint(paint);
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  mRenderOp.vertexData = new Ogre::VertexData();
  mRenderOp.vertexData->vertexCount = paint.size();
  declareVertices(*mRenderOp.vertexData->vertexDeclaration);
  mRenderOp.vertexData->vertexBufferBinding->setBinding(POSITION_STREAM, positions_);
  mRenderOp.vertexData->vertexBufferBinding->setBinding(PAINT_STREAM, paint_);
  mRenderOp.indexData = new Ogre::IndexData();
  mRenderOp.indexData->indexCount = triangles.size();
  mRenderOp.indexData->indexBuffer = indexBuffer(triangles, paint.size());
  setBox(positions, margin);
}

void Batch::setBox(const std::vector<float>& positions, float margin) {
  Ogre::AxisAlignedBox box;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3)
    box.merge(Ogre::Vector3(positions[i], positions[i + 1], positions[i + 2]));
  const Ogre::Vector3 around(margin, margin, margin);
  setBoundingBox(Ogre::AxisAlignedBox(box.getMinimum() - around, box.getMaximum() + around));
  if (getParentNode() != nullptr) getParentNode()->needUpdate();
}

void Batch::setAnchors(const std::vector<float>& anchors) {
  if (mRenderOp.vertexData == nullptr) return;
  anchors_ = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      3 * sizeof(float), anchors.size() / 3, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  anchors_->writeData(0, sizeof(float) * anchors.size(), anchors.data(), true);
  mRenderOp.vertexData->vertexDeclaration->addElement(ANCHOR_STREAM, 0, Ogre::VET_FLOAT3,
                                                      Ogre::VES_TEXTURE_COORDINATES, 2);
  mRenderOp.vertexData->vertexBufferBinding->setBinding(ANCHOR_STREAM, anchors_);
}

void Batch::share(const Batch& other) {
  clear();
  if (other.mRenderOp.vertexData == nullptr) return;
  mRenderOp.operationType = other.mRenderOp.operationType;
  mRenderOp.useIndexes = true;
  mRenderOp.vertexData = other.mRenderOp.vertexData->clone(false);
  mRenderOp.indexData = other.mRenderOp.indexData->clone(false);
  setBoundingBox(other.mBox);
}

std::size_t Batch::triangleCount() const {
  return mRenderOp.indexData == nullptr ? 0 : mRenderOp.indexData->indexBuffer->getNumIndexes() / 3;
}

void Batch::move(const std::vector<float>& positions) {
  if (positions_.get() != nullptr)
    positions_->writeData(0, sizeof(float) * positions.size(), positions.data(), true);
}

void Batch::limit(std::size_t triangles) {
  if (mRenderOp.indexData == nullptr) return;
  const std::size_t all = mRenderOp.indexData->indexBuffer->getNumIndexes();
  mRenderOp.indexData->indexCount = std::min(all, 3 * triangles);
}

void Batch::reorder(const std::vector<std::uint32_t>& triangles) {
  if (mRenderOp.indexData == nullptr) return;
  mRenderOp.indexData->indexBuffer = indexBuffer(triangles, mRenderOp.vertexData->vertexCount);
}

void Batch::paint(const std::vector<VertexPaint>& paint) {
  if (paint_.get() != nullptr)
    paint_->writeData(0, sizeof(VertexPaint) * paint.size(), paint.data(), true);
}

bool Batch::takeSeen() {
  const bool out = seen_;
  seen_ = false;
  return out;
}

void Batch::setRank(int rank) {
  setRenderQueueGroupAndPriority(Ogre::RENDER_QUEUE_3,
                                 static_cast<Ogre::ushort>(std::min(rank, LAST_RANK)));
}

// Ogre culls by node, and many batches share one.
void Batch::_notifyCurrentCamera(Ogre::Camera* camera) {
  Ogre::SimpleRenderable::_notifyCurrentCamera(camera);
  in_view_ = camera->isVisible(getWorldBoundingBox(true));
}

void Batch::_updateRenderQueue(Ogre::RenderQueue* queue) {
  if (!in_view_) return;
  seen_ = true;
  if (mRenderOp.indexData != nullptr && mRenderOp.indexData->indexCount > 0)
    Ogre::SimpleRenderable::_updateRenderQueue(queue);
}

void Batch::postRender(Ogre::SceneManager* /*scene*/, Ogre::RenderSystem* /*renderer*/) {
  drew(mRenderOp.indexData->indexCount / 3);
}

Ogre::Real Batch::getBoundingRadius() const {
  return mBox.isFinite() ? 0.5f * mBox.getSize().length() + mBox.getCenter().length() : 0.f;
}

Ogre::Real Batch::getSquaredViewDepth(const Ogre::Camera* camera) const {
  return mBox.isFinite() ? (camera->getDerivedPosition() - mBox.getCenter()).squaredLength() : 0.f;
}

}  // namespace vegetation_sim::view
