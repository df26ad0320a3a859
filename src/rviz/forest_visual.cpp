// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vegetation_sim/rviz/forest_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <chrono>

#include "vegetation_sim/rviz/bark_picture.h"
#include "vegetation_sim/rviz/leaf_atlas.h"

namespace vegetation_sim::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int LEAF_EDGE = 256, BARK_EDGE = 512;  // [pixel]
constexpr std::size_t TREES_PER_GROVE = 10;
// [s] of one update: growing while nothing is drawn and while something is; choosing levels while
// trees have no mesh yet and later.
constexpr double GROW_TIME = 0.025, SIDE_TIME = 0.006, FIRST_TIME = 0.06, LEVEL_TIME = 0.010;
constexpr double RESELECT = 25.0;  // [m] of the eye's way until other trees are the nearest

double pixelsOf(const DrawnTree& tree, const View& view) {
  const Vec3 middle = tree.foot() + Vec3(0.0, 0.0, 0.5 * tree.height());
  return forest::pixelsPerMetre(view.eye, length(middle - view.eye.position) - tree.reach());
}

// Painted once in a process.
const std::vector<Picture>& sharedLeafAtlas() {
  static const std::vector<Picture> atlas = leafAtlas(LEAF_EDGE);
  return atlas;
}

bool isSeen(const DrawnTree& tree, const View& view) {
  return view.sees(tree.foot() + Vec3(0.0, 0.0, 0.5 * tree.height()),
                   tree.reach() + 0.5 * tree.height());
}

}  // namespace

ForestVisual::ForestVisual(Ogre::SceneNode& parent)
    : parent_(parent),
      node_(parent.createChildSceneNode()),
      leaf_texture_(uniqueName("leaf_picture"), sharedLeafAtlas()),
      bark_texture_(uniqueName("bark_picture"), mipmaps(barkAtlas(BARK_EDGE), 16)),
      leaf_material_(Material::Kind::LEAVES, uniqueName("leaf_material"), {leaf_texture_.name()}),
      bark_material_(Material::Kind::BARK, uniqueName("bark_material"), {bark_texture_.name()}) {}

ForestVisual::~ForestVisual() {
  groves_.clear();
  node_->getCreator()->destroySceneNode(node_);
}

void ForestVisual::restart(const forest::ForestReplica& replica, const View& view,
                           const Options& options) {
  groves_.clear();
  stock_.reset();
  report_ = ForestReport();
  repaint_ = false;
  select(replica, view, options);
}

void ForestVisual::select(const forest::ForestReplica& replica, const View& view,
                          const Options& options) {
  next_ = std::make_unique<TreeStock>(
      replica, nearestTrees(replica.layout(), view.eye.position, options.most_trees));
  selected_at_ = view.eye.position;
  selected_all_ = next_->wanted() == replica.layout().treeCount();
  report_.wanted = next_->wanted();
}

// The trees that have grown take the place of those drawn so far.
void ForestVisual::adopt() {
  groves_.clear();
  stock_ = std::move(next_);
  ++stocks_;
  const Vec3& origin = stock_->origin();
  node_->setPosition(static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                     static_cast<float>(origin.z()));
  std::vector<DrawnTree*> trees;
  for (const auto& tree : stock_->trees()) trees.push_back(tree.get());
  if (trees.empty()) return;
  for (auto& group : splitByPlace(std::move(trees), TREES_PER_GROVE))
    groves_.push_back(std::make_unique<Grove>(std::move(group), *node_, bark_material_.name(),
                                              leaf_material_.name()));
}

void ForestVisual::repaint() {
  repaint_ = true;
}

void ForestVisual::light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze) {
  leaf_material_.light(daylight, to_sun, haze);
  bark_material_.light(daylight, to_sun, haze);
}

void ForestVisual::update(const forest::ForestReplica& replica, Nanoseconds stamp, const View& view,
                          const Daylight& daylight, const Options& options) {
  const bool away = length(view.eye.position - selected_at_) > RESELECT;
  if (stock_ && !next_ && !selected_all_ && away) select(replica, view, options);
  if (next_ &&
      next_->grow(replica, daylight.to_sun, options.look.leaves, stock_ ? SIDE_TIME : GROW_TIME))
    adopt();
  if (!stock_) return;
  chooseLevels(view, options);
  move(replica, stamp, view, options);
  measure(view, options);
}

// Near groves first: they are drawn first, and the first to get their level when time is short.
void ForestVisual::chooseLevels(const View& view, const Options& options) {
  const bool bare = report_.triangles == 0 || report_.waiting > groves_.size();
  const auto end = Clock::now() + std::chrono::duration<double>(bare ? FIRST_TIME : LEVEL_TIME);
  std::sort(groves_.begin(), groves_.end(), [&](const auto& a, const auto& b) {
    return (a->middle() - view.eye.position).squaredNorm() <
           (b->middle() - view.eye.position).squaredNorm();
  });
  report_.waiting = 0;
  int rank = 0;
  for (const auto& grove : groves_) {
    grove->setRank(rank++);
    bool changed = false;
    for (DrawnTree* tree : grove->trees()) {
      const double size = pixelsOf(*tree, view) * tree->height() * feedback_.factor();
      const int level = forest::geometryLevel(size, tree->level());
      if (level == tree->level() && !repaint_) continue;
      if (!repaint_ && Clock::now() >= end) {
        ++report_.waiting;
        continue;
      }
      tree->setLevel(level, stock_->light(), options.look);
      changed = true;
    }
    if (changed) {
      grove->rebuild();
      grove->moved_to = -1;
    }
    if (Clock::now() < end) grove->sortFor(view.eye.position);
  }
  repaint_ = false;
}

// While time stands still nothing moves, and nothing is computed.
void ForestVisual::move(const forest::ForestReplica& replica, Nanoseconds stamp, const View& view,
                        const Options& options) {
  const wind::Instant wind = replica.wind().at(stamp);
  report_.moving = 0;
  for (const auto& grove : groves_) {
    if (!grove->takeSeen() || grove->moved_to == stamp) continue;
    grove->moved_to = stamp;
    bool moved = false, painted = false;
    for (DrawnTree* tree : grove->trees()) {
      const bool moves = tree->move(replica, stamp, wind, options.look, pixelsOf(*tree, view));
      report_.moving += moves ? 1 : 0;
      moved = moved || moves;
      painted = tree->paintLevels(replica, stamp, options.look) || painted;
    }
    if (moved) grove->takePositions();
    if (painted) grove->takePaint();
  }
}

void ForestVisual::measure(const View& view, const Options& options) {
  report_.trees = stock_->trees().size();
  report_.triangles = 0;
  report_.per_level.fill(0);
  for (const auto& tree : stock_->trees()) {
    if (tree->level() < 0) continue;
    ++report_.per_level[static_cast<std::size_t>(tree->level())];
    if (isSeen(*tree, view)) report_.triangles += tree->triangleCount();
  }
  if (report_.waiting == 0 && report_.triangles > 0)
    feedback_.update(static_cast<double>(report_.triangles), options.target_triangles);
}

}  // namespace vegetation_sim::view
