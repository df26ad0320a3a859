// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/render/texture.h"

#include <OgreHardwarePixelBuffer.h>
#include <OgreResourceGroupManager.h>
#include <OgreTextureManager.h>

namespace vegetation_sim::view {

Texture::Texture(const std::string& name, const std::vector<Image>& mipmaps) : name_(name) {
  const Image& full = mipmaps.front();
  const Ogre::TexturePtr texture = Ogre::TextureManager::getSingleton().createManual(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, Ogre::TEX_TYPE_2D,
      static_cast<Ogre::uint>(full.columns), static_cast<Ogre::uint>(full.rows),
      static_cast<int>(mipmaps.size()) - 1, Ogre::PF_BYTE_RGBA, Ogre::TU_STATIC_WRITE_ONLY);
  for (std::size_t level = 0; level < mipmaps.size(); ++level) {
    std::vector<std::uint8_t> bytes = mipmaps[level].bytes();
    const Ogre::PixelBox box(static_cast<Ogre::uint32>(mipmaps[level].columns),
                             static_cast<Ogre::uint32>(mipmaps[level].rows), 1, Ogre::PF_BYTE_RGBA,
                             bytes.data());
    texture->getBuffer(0, level)->blitFromMemory(box);
  }
}

void Texture::update(int column, int row, Image part) {
  const Ogre::TexturePtr texture = Ogre::TextureManager::getSingleton().getByName(name_);
  for (std::size_t level = 0; level <= texture->getNumMipmaps(); ++level) {
    std::vector<std::uint8_t> bytes = part.bytes();
    const auto columns = static_cast<Ogre::uint32>(part.columns);
    const auto rows = static_cast<Ogre::uint32>(part.rows);
    const auto left = static_cast<Ogre::uint32>(column), top = static_cast<Ogre::uint32>(row);
    const Ogre::PixelBox from(columns, rows, 1, Ogre::PF_BYTE_RGBA, bytes.data());
    texture->getBuffer(0, level)->blitFromMemory(from,
                                                 Ogre::Box(left, top, left + columns, top + rows));
    if ((column | row | part.columns | part.rows) % 2 != 0) return;
    part = halved(part);
    column /= 2;
    row /= 2;
  }
}

Texture::~Texture() {
  if (Ogre::TextureManager::getSingletonPtr() != nullptr)
    Ogre::TextureManager::getSingleton().remove(name_);
}

std::string uniqueName(const std::string& what) {
  static int made = 0;  // render thread only
  return "vegetation_sim/" + what + "/" + std::to_string(made++);
}

}  // namespace vegetation_sim::view
