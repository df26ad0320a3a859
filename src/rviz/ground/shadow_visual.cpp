// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/ground/shadow_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <utility>

namespace vegetation_sim::view {
namespace {

constexpr int EDGE = 1024;                // [pixel]
constexpr double LIFT = 0.2, CELL = 2.0;  // [m] height above the ground; cell of the mesh
constexpr int MOST_SHADOW_CELLS = 120;    // along an edge
constexpr double UPDATE_TIME = 3e-3;      // [s] of painting in one update

}  // namespace

ShadowVisual::ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set,
                           const terrain::HeightMap& terrain, const Daylight& daylight)
    : ShadowVisual(parent, tree_set, terrain,
                   overlayPicture(shadowsOn(plotAround(tree_set.extent()), EDGE, tree_set, terrain,
                                            daylight.to_sun),
                                  EDGE, wholePlot(EDGE)),
                   nullptr) {}

ShadowVisual::ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set,
                           const terrain::HeightMap& terrain, std::unique_ptr<MovingShadows> moving)
    : ShadowVisual(parent, tree_set, terrain,
                   overlayPicture(moving->light(), moving->edge(), wholePlot(moving->edge())),
                   std::move(moving)) {}

ShadowVisual::ShadowVisual(Ogre::SceneNode& parent, const TreeSet& tree_set,
                           const terrain::HeightMap& terrain, const Image& picture,
                           std::unique_ptr<MovingShadows>&& moving)
    : node_(parent.createChildSceneNode()),
      moving_(std::move(moving)),
      texture_(uniqueName("overlay_picture"), mipmaps(picture)),
      material_(Material::Kind::SHADOWS, uniqueName("overlay_material"), {texture_.name()}),
      overlay_(uniqueName("overlay"), material_.name()) {
  const Plot plot = plotAround(tree_set.extent());
  const Vec3& origin = tree_set.origin();
  node_->setPosition(static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                     static_cast<float>(origin.z()));
  const int cells = std::clamp(static_cast<int>(plot.edge / CELL), 1, MOST_SHADOW_CELLS);
  std::vector<float> positions;
  std::vector<VertexPaint> paint;
  std::vector<std::uint32_t> triangles;
  for (int r = 0; r <= cells; ++r) {
    for (int c = 0; c <= cells; ++c) {
      const double u = static_cast<double>(c) / cells, v = static_cast<double>(r) / cells;
      const double x = plot.x + plot.edge * u, y = plot.y + plot.edge * v;
      const Vec3 at = Vec3(x, y, terrain.height(x, y) + LIFT) - origin;
      for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(at[k]));
      paint.push_back({{0.f, 0.f, 1.f},
                       {16, 24, 20, 255},
                       {static_cast<float>(u), static_cast<float>(1.0 - v), 1.f}});
      if (r == cells || c == cells) continue;
      const auto a = static_cast<std::uint32_t>(r * (cells + 1) + c);
      const std::uint32_t b = a + static_cast<std::uint32_t>(cells) + 1;
      triangles.insert(triangles.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
  overlay_.build(positions, paint, triangles, 0.f);
  // It is drawn after grass, ground and walkers, which hide it where they are in front.
  overlay_.setRenderQueueGroupAndPriority(Ogre::RENDER_QUEUE_3, Batch::LAST_RANK + 2);
  node_->attachObject(&overlay_);
}

ShadowVisual::~ShadowVisual() {
  node_->detachAllObjects();
  node_->getCreator()->destroySceneNode(node_);
}

void ShadowVisual::update(const forest::ForestReplica& replica, Nanoseconds stamp,
                          const Vec3& viewer) {
  if (!moving_) return;
  moving_->follow(viewer);
  const bool painted = moving_->paint(replica, stamp, UPDATE_TIME);
  late_ = !moving_->isComplete(stamp);
  if (!painted) return;
  const Window changed = moving_->takeChanged();
  if (changed.columns * changed.rows == 0) return;
  texture_.update(changed.column, moving_->edge() - changed.row - changed.rows,
                  overlayPicture(moving_->light(), moving_->edge(), changed));
}

void ShadowVisual::light(const Daylight& daylight, const Haze& haze) {
  material_.light(daylight, daylight.to_sun, haze);
}

}  // namespace vegetation_sim::view
