// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreAxisAlignedBox.h>  // it includes vectors, whose header differs between versions

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::view {

inline Vec3 toVec3(const Ogre::Vector3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Ogre::Vector3 toOgre(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace vegetation_sim::view
