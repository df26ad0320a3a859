// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "rviz/textures/image.h"

namespace vegetation_sim::view {

/// A texture in Ogre made of pictures, the first in full size, each other half as large; gone with
/// this object. Render thread only.
class Texture {
 public:
  /// @param name unique among Ogre's textures.
  Texture(const std::string& name, const std::vector<Image>& mipmaps);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  const std::string& name() const { return name_; }
  /// Paints a part anew, in all sizes down to where it is a pixel. Its place and size are to be
  /// multiples of a power of two, so that it covers whole pixels of the smaller pictures.
  void update(int column, int row, Image part);

 private:
  std::string name_;
};

/// Name that no other Ogre resource has.
std::string uniqueName(const std::string& what);

}  // namespace vegetation_sim::view
