// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/scenery/sky_visual.h"

#include <OgreRenderQueue.h>
#include <OgreSceneManager.h>

#include "vegetation_sim/core/math/math.h"

namespace vegetation_sim::view {
namespace {

constexpr int COLUMNS = 2048, ROWS = 512;  // of the texture
constexpr int AROUND = 48, UP = 16;        // quads of the dome
constexpr double RADIUS = 8000.0;          // [m] beyond everything else

// It is made once per process.
const SkyShapes& sharedShapes() {
  static const SkyShapes shapes(COLUMNS, ROWS);
  return shapes;
}

}  // namespace

SkyVisual::SkyVisual(Ogre::SceneNode& parent, const Daylight& daylight)
    : node_(parent.createChildSceneNode()),
      texture_(uniqueName("sky_picture"), {skyPicture(daylight, sharedShapes())}),
      material_(Material::Kind::SKY, uniqueName("sky_material"), {texture_.name()}),
      dome_(uniqueName("sky"), material_.name()) {
  std::vector<float> positions;
  std::vector<VertexPaint> paint;
  std::vector<std::uint32_t> triangles;
  for (int r = 0; r <= UP + 1; ++r) {
    // The last ring is straight below: all below the horizon has the horizon's colour.
    const double v = static_cast<double>(r) / UP;
    const SinCos e = r > UP ? SinCos{-1.0, 0.0} : sinCos(skyElevation(v));
    for (int c = 0; c <= AROUND; ++c) {
      const SinCos a = sinCos(2.0 * PI * c / AROUND);
      for (const double x : {e.cos * a.cos, e.cos * a.sin, e.sin})
        positions.push_back(static_cast<float>(RADIUS * x));
      const float row = static_cast<float>(std::min(v, 1.0) * (ROWS - 1) + 0.5) / ROWS;
      paint.push_back(
          {{0.f, 0.f, 1.f}, {255, 255, 255, 255}, {static_cast<float>(c) / AROUND, row, 1.f}});
      if (r > UP || c == AROUND) continue;
      const auto first = static_cast<std::uint32_t>(r * (AROUND + 1) + c);
      const std::uint32_t below = first + AROUND + 1;
      triangles.insert(triangles.end(), {first, below, below + 1, first, below + 1, first + 1});
    }
  }
  dome_.build(positions, paint, triangles, 0.f);
  dome_.setRenderQueueGroup(Ogre::RENDER_QUEUE_4);  // after trees and ground, which hide most of it
  node_->attachObject(&dome_);
}

SkyVisual::~SkyVisual() {
  node_->detachAllObjects();
  node_->getCreator()->destroySceneNode(node_);
}

void SkyVisual::follow(const Vec3& eye) {
  node_->setPosition(static_cast<float>(eye.x()), static_cast<float>(eye.y()),
                     static_cast<float>(eye.z()));
}

}  // namespace vegetation_sim::view
