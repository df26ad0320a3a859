// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// An Ogre texture made of images: the first in full size, each next one half as large. The
/// destructor removes it. Render thread only.
class Texture {
 public:
  /// @param name must be unique among Ogre's textures.
  Texture(const std::string& name, const std::vector<Image>& mipmaps);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  const std::string& name() const { return name_; }
  /// Replaces a part in every mipmap level down to one pixel. Its place and size must be multiples
  /// of a power of two, so that it covers whole pixels of the smaller levels.
  void update(int column, int row, Image part);

 private:
  std::string name_;
};

/// Returns a name that no other Ogre resource has.
std::string uniqueName(const std::string& what);

}  // namespace vegetation_sim::view
