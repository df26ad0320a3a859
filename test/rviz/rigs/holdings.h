// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreGpuProgramManager.h>
#include <OgreHardwareBufferManager.h>
#include <OgreHighLevelGpuProgramManager.h>
#include <OgreMaterialManager.h>
#include <OgreMeshManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTextureManager.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>
#include <ostream>

namespace vegetation_sim {

/// Counts of the objects that Ogre holds.
struct Holdings {
  std::size_t textures{0}, materials{0}, meshes{0}, programs{0}, buffers{0}, nodes{0}, objects{0};
  std::size_t texture_bytes{0};

  /// Returns the counts without objects that depend on levels of detail.
  Holdings lasting() const {
    Holdings out = *this;
    out.buffers = out.objects = 0;
    return out;
  }
  bool operator==(const Holdings& other) const {
    return textures == other.textures && materials == other.materials && meshes == other.meshes &&
           programs == other.programs && buffers == other.buffers && nodes == other.nodes &&
           objects == other.objects && texture_bytes == other.texture_bytes;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Holdings& held) {
  for (const std::size_t count : {held.textures, held.materials, held.meshes, held.programs,
                                  held.buffers, held.nodes, held.objects})
    out << count << ',';
  return out << held.texture_bytes;
}

inline std::size_t countOf(Ogre::ResourceManager& manager) {
  std::size_t out = 0;
  auto all = manager.getResourceIterator();
  for (; all.hasMoreElements(); all.moveNext()) ++out;
  return out;
}

/// Gives access to Ogre's lists of vertex and index buffers, which have no public getter.
struct BufferCounter : Ogre::HardwareBufferManagerBase {
  static std::size_t count(const Ogre::HardwareBufferManagerBase& manager) {
    return (manager.*(&BufferCounter::mVertexBuffers)).size() +
           (manager.*(&BufferCounter::mIndexBuffers)).size();
  }
};

inline void countBelow(const Ogre::SceneNode& node, Holdings& held) {
  ++held.nodes;
  held.objects += node.numAttachedObjects();
  for (unsigned short i = 0; i < node.numChildren(); ++i)
    countBelow(static_cast<const Ogre::SceneNode&>(*node.getChild(i)), held);
}

inline Holdings holdings(Ogre::SceneManager& scene) {
  Holdings out;
  out.textures = countOf(Ogre::TextureManager::getSingleton());
  out.texture_bytes = Ogre::TextureManager::getSingleton().getMemoryUsage();
  out.materials = countOf(Ogre::MaterialManager::getSingleton());
  out.meshes = countOf(Ogre::MeshManager::getSingleton());
  out.programs = countOf(Ogre::GpuProgramManager::getSingleton()) +
                 countOf(Ogre::HighLevelGpuProgramManager::getSingleton());
  out.buffers = BufferCounter::count(Ogre::HardwareBufferManager::getSingleton());
  countBelow(*scene.getRootSceneNode(), out);
  return out;
}

/// Returns the resident memory of this process [MB].
inline double residentMemory() {
  std::ifstream file("/proc/self/statm");
  double size = 0.0, resident = 0.0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

/// Returns the allocated memory that was not freed [MB].
inline double heldMemory() {
#if __GLIBC_PREREQ(2, 33)
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / 1e6;
#else
  return residentMemory();
#endif
}

}  // namespace vegetation_sim
