// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/forest/forest_visual.h"

#include <OgreSceneManager.h>

#include <algorithm>
#include <chrono>

#include "rviz/textures/bark_texture.h"
#include "rviz/textures/leaf_atlas.h"

namespace vegetation_sim::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int LEAF_EDGE = 256, BARK_EDGE = 512;  // [pixel]
constexpr std::size_t TREES_PER_BATCH = 4;
// [s] of one update: growing while nothing is drawn (GROW) or trees are (SIDE), choosing levels
// while trees have no mesh (FIRST) or later (LEVEL).
constexpr double GROW_TIME = 0.025, SIDE_TIME = 0.006, FIRST_TIME = 0.06, LEVEL_TIME = 0.010;
constexpr double FADE_TIME = 0.5;     // [s] from one level to another
constexpr double LARGEST_FADE = 0.1;  // part of a fade between two updates
constexpr std::size_t FADERS = 8;     // 8 trees, or one in 8, fade at a time: each costs two
constexpr double RESELECT = 25.0;     // [m] the viewer moves until trees are selected again

double pixelsOf(const DrawnTree& tree, const View& view) {
  const Vec3 middle = tree.foot() + Vec3(0.0, 0.0, 0.5 * tree.height());
  return forest::pixelsPerMetre(view.eye, length(middle - view.eye.position) - tree.reach());
}

// Painted once per process.
const std::vector<Image>& sharedLeafAtlas() {
  static const std::vector<Image> atlas = leafAtlas(LEAF_EDGE);
  return atlas;
}

const std::vector<Image>& sharedBarkAtlas() {
  static const std::vector<Image> atlas = mipmaps(barkAtlas(BARK_EDGE), 16);
  return atlas;
}

bool isSeen(const DrawnTree& tree, const View& view) {
  return view.sees(tree.foot() + Vec3(0.0, 0.0, 0.5 * tree.height()),
                   tree.reach() + 0.5 * tree.height());
}

// Returns whether a camera has drawn the batch, or the viewer is about to.
bool isSeen(TreeBatch& batch, const View& view) {
  return batch.takeSeen() ||
         std::any_of(batch.trees().begin(), batch.trees().end(),
                     [&](const DrawnTree* tree) { return isSeen(*tree, view); });
}

}  // namespace

ForestVisual::ForestVisual(Ogre::SceneNode& parent)
    : node_(parent.createChildSceneNode()),
      leaf_texture_(uniqueName("leaf_picture"), sharedLeafAtlas()),
      bark_texture_(uniqueName("bark_picture"), sharedBarkAtlas()),
      leaf_material_(Material::Kind::LEAVES, uniqueName("leaf_material"), {leaf_texture_.name()}),
      bark_material_(Material::Kind::BARK, uniqueName("bark_material"), {bark_texture_.name()}),
      fading_leaf_material_(Material::Kind::LEAVES, uniqueName("fading_leaf_material"),
                            {leaf_texture_.name()}, Material::Variant::FADING),
      fading_bark_material_(Material::Kind::BARK, uniqueName("fading_bark_material"),
                            {bark_texture_.name()}, Material::Variant::FADING),
      near_leaf_material_(Material::Kind::LEAVES, uniqueName("near_leaf_material"),
                          {leaf_texture_.name()}, Material::Variant::NEAR) {}

ForestVisual::~ForestVisual() {
  pieces_.clear();
  tree_batches_.clear();
  node_->getCreator()->destroySceneNode(node_);
}

void ForestVisual::restart(const forest::ForestReplica& replica, const View& view,
                           const Options& options) {
  pieces_.clear();
  tree_batches_.clear();
  tree_set_.reset();
  report_ = ForestReport();
  repaint_ = false;
  select(replica, view, options);
}

void ForestVisual::select(const forest::ForestReplica& replica, const View& view,
                          const Options& options) {
  next_ = std::make_unique<TreeSet>(
      replica, nearestTrees(replica.layout(), view.eye.position, options.most_trees));
  prepared_ = 0;
  selected_at_ = view.eye.position;
  selected_all_ = next_->wanted() == replica.layout().treeCount();
  report_.wanted = next_->wanted();
}

// Builds the meshes of the next trees before they replace the current ones, so that none is
// missing. A tree that is in both sets keeps its level.
bool ForestVisual::prepare(const View& view, const Options& options) {
  if (!tree_set_) return true;
  const auto end = Clock::now() + std::chrono::duration<double>(SIDE_TIME);
  for (; prepared_ < next_->trees().size(); ++prepared_) {
    if (Clock::now() >= end) return false;
    DrawnTree& tree = *next_->trees()[prepared_];
    const DrawnTree* before = tree_set_->find(tree.id());
    const bool built = before != nullptr && before->level() >= 0;
    tree.setLevels(
        built ? before->levels() : tree.levelsFor(view.eye, feedback_.factor(), options.by_bough),
        next_->light(), options.look);
  }
  return true;
}

// Replaces the trees that are drawn with those that have grown.
void ForestVisual::applyDelta() {
  const bool follows = tree_set_ != nullptr;
  pieces_.clear();  // of another origin
  tree_batches_.clear();
  settled_ = settled_ && follows;
  tree_set_ = std::move(next_);
  ++tree_sets_;
  const Vec3& origin = tree_set_->origin();
  node_->setPosition(static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                     static_cast<float>(origin.z()));
  std::vector<DrawnTree*> trees;
  for (const auto& tree : tree_set_->trees()) trees.push_back(tree.get());
  if (trees.empty()) return;
  const TreeMaterials materials = treeMaterials();
  for (auto& group : splitByPlace(std::move(trees), TREES_PER_BATCH))
    tree_batches_.push_back(std::make_unique<TreeBatch>(std::move(group), *node_, materials));
  if (!follows) return;
  for (const auto& batch : tree_batches_) batch->rebuild();
}

TreeMaterials ForestVisual::treeMaterials() const {
  return {bark_material_.name(), leaf_material_.name(), fading_bark_material_.name(),
          fading_leaf_material_.name(), near_leaf_material_.name()};
}

void ForestVisual::repaint() {
  repaint_ = true;
  pieces_.clear();
  prepared_ = 0;
}

void ForestVisual::light(const Daylight& daylight, const Vec3& to_sun, const Haze& haze) {
  for (Material* material : {&leaf_material_, &bark_material_, &fading_leaf_material_,
                             &fading_bark_material_, &near_leaf_material_})
    material->light(daylight, to_sun, haze);
}

void ForestVisual::update(const forest::ForestReplica& replica, Nanoseconds stamp, double wall,
                          const View& view, const Daylight& daylight, const Options& options) {
  const bool away = length(view.eye.position - selected_at_) > RESELECT;
  if (tree_set_ && !next_ && !selected_all_ && away) select(replica, view, options);
  if (next_ &&
      next_->grow(replica, daylight.to_sun, options.look.leaves,
                  tree_set_ ? SIDE_TIME : GROW_TIME) &&
      prepare(view, options))
    applyDelta();
  if (!tree_set_) return;
  runFadeClock(wall);
  chooseLevels(replica, view, options);
  move(replica, stamp, view, options);
  updatePieces(replica);
  movePieces(replica, stamp, view, options);
  measure(view, options);
}

// A fade takes FADE_TIME, or longer at a low frame rate, to avoid steps.
void ForestVisual::runFadeClock(double wall) {
  fade_clock_ += std::clamp((wall - wall_) / FADE_TIME, 0.0, LARGEST_FADE);
  if (report_.fading == 0) fade_clock_ = 1.0;
  wall_ = wall;
  fading_leaf_material_.setFadeClock(static_cast<float>(fade_clock_));
  fading_bark_material_.setFadeClock(static_cast<float>(fade_clock_));
}

// Visible trees fade from level to level. Others change at once, and so do all trees until the
// levels have settled for the first time.
bool ForestVisual::changeLevel(DrawnTree& tree, const View& view, const Options& options,
                               bool in_time) {
  const auto clock = static_cast<float>(fade_clock_);
  const bool ends = tree.fading() && clock - tree.fadesSince() >= 1.f;
  if (ends) tree.endFade();
  const forest::TreeLevels levels = tree.levelsFor(view.eye, feedback_.factor(), options.by_bough);
  const bool same = levels == tree.levels();
  // Levels of boughs wait for the factor to settle, since each change takes a fade.
  const bool of_boughs =
      !same && levels.trunk == tree.level() && feedback_.factor() != last_factor_;
  if ((same || of_boughs) && !repaint_) return ends;
  const bool fades = settled_ && !same && isSeen(tree, view);
  const bool room = report_.fading < std::max(FADERS, tree_set_->trees().size() / FADERS);
  if (!repaint_ && (!in_time || tree.fading() || (fades && !room))) {
    ++report_.waiting;
    return ends;
  }
  tree.setLevels(levels, tree_set_->light(), options.look, fades ? clock : 0.f);
  return true;
}

// A tree that has lost branches is drawn without them at once.
bool ForestVisual::regrow(const forest::ForestReplica& replica, DrawnTree& tree,
                          const Options& options) {
  if (!tree.isOutdated(replica)) return false;
  tree.regrow(replica);
  if (tree.level() < 0) return false;
  tree.setLevels(forest::TreeLevels(tree.levels()), tree_set_->light(), options.look);
  return true;
}

// Near batches are drawn first, and are the first to get their level if time is short.
void ForestVisual::chooseLevels(const forest::ForestReplica& replica, const View& view,
                                const Options& options) {
  const bool bare = report_.triangles == 0 || report_.waiting > tree_batches_.size();
  const auto end = Clock::now() + std::chrono::duration<double>(bare ? FIRST_TIME : LEVEL_TIME);
  std::sort(tree_batches_.begin(), tree_batches_.end(), [&](const auto& a, const auto& b) {
    return (a->middle() - view.eye.position).squaredNorm() <
           (b->middle() - view.eye.position).squaredNorm();
  });
  report_.waiting = report_.fading = 0;
  for (const auto& batch : tree_batches_)
    for (const DrawnTree* tree : batch->trees()) report_.fading += tree->fading() ? 1 : 0;
  int rank = 0;
  bool still = true;
  for (const auto& batch : tree_batches_) {
    batch->setRank(rank++);
    batch->setEye(view.eye.position);
    bool changed = false;
    for (DrawnTree* tree : batch->trees()) {
      const int before = tree->fading() ? 1 : 0;
      changed = regrow(replica, *tree, options) || changed;
      changed = changeLevel(*tree, view, options, Clock::now() < end) || changed;
      report_.fading += (tree->fading() ? 1 : 0) - before;
    }
    still = still && !changed;
    if (changed) {
      batch->rebuild();
      batch->moved_to = -1;
    }
    if (Clock::now() < end) batch->sortFor(view.eye.position);
  }
  repaint_ = false;
  settled_ = settled_ || (still && report_.waiting == 0);
}

// Batches whose stamp has not changed are skipped.
void ForestVisual::move(const forest::ForestReplica& replica, Nanoseconds stamp, const View& view,
                        const Options& options) {
  static const std::vector<int> NONE;
  const auto heldOf = [&](std::uint32_t tree) -> const std::vector<int>& {
    const auto found = options.held.find(tree);
    return found == options.held.end() ? NONE : found->second;
  };
  const wind::Instant wind = replica.wind().at(stamp);
  report_.moving = 0;
  for (const auto& batch : tree_batches_) {
    if (!isSeen(*batch, view) || batch->moved_to == stamp) continue;
    batch->moved_to = stamp;
    bool moved = false, painted = false;
    for (DrawnTree* tree : batch->trees()) {
      const bool moves = tree->move(replica, stamp, wind, options.look, pixelsOf(*tree, view));
      report_.moving += moves ? 1 : 0;
      moved = moved || moves;
      painted = tree->paintStates(replica, stamp, options.look, heldOf(tree->id())) || painted;
    }
    if (moved) batch->takePositions();
    if (painted) batch->takePaint();
  }
}

// Grows one piece at a time. Those of trees that are not drawn are not drawn either.
void ForestVisual::updatePieces(const forest::ForestReplica& replica) {
  for (auto it = pieces_.begin(); it != pieces_.end();) {
    const auto& [tree, number] = it->first;
    const auto& broken = brokenOf(replica.broken(), tree);
    const bool is_there = number < broken.size() && it->second.tree->isPiece(broken[number]);
    it = is_there ? std::next(it) : pieces_.erase(it);
  }
  report_.pieces = pieces_.size();
  for (const auto& [tree, broken] : replica.broken()) {
    if (!tree_set_->find(tree)) continue;
    for (std::size_t number = 0; number < broken.size(); ++number) {
      if (pieces_.count({tree, number})) continue;
      pieces_.emplace(std::make_pair(tree, number), growPiece(replica, tree, number));
      return;
    }
  }
}

ForestVisual::Piece ForestVisual::growPiece(const forest::ForestReplica& replica,
                                            std::uint32_t tree, std::size_t number) {
  Piece out;
  out.tree = std::make_unique<DrawnTree>(
      replica, tree, tree_set_->origin(),
      std::make_shared<const forest::FallingPiece>(replica.layout(), replica.terrain(), tree,
                                                   brokenOf(replica.broken(), tree), number));
  out.batch =
      std::make_unique<TreeBatch>(std::vector<DrawnTree*>{out.tree.get()}, *node_, treeMaterials());
  return out;
}

// A piece has the level of detail of its tree.
void ForestVisual::movePieces(const forest::ForestReplica& replica, Nanoseconds stamp,
                              const View& view, const Options& options) {
  const wind::Instant wind = replica.wind().at(stamp);
  for (auto& entry : pieces_) {
    Piece& piece = entry.second;
    const int level = tree_set_->find(piece.tree->id())->level();
    if (level < 0) continue;
    piece.batch->setEye(view.eye.position);
    const bool changed = level != piece.tree->level();
    if (changed) {
      piece.tree->setLevels({level, {}}, tree_set_->light(), options.look);
      piece.batch->rebuild();
    }
    if (piece.tree->move(replica, stamp, wind, options.look, 1.0)) piece.batch->takePositions();
  }
}

void ForestVisual::measure(const View& view, const Options& options) {
  report_.trees = tree_set_->trees().size();
  report_.tree_sets = tree_sets_;
  report_.triangles = 0;
  report_.per_level.fill(0);
  last_factor_ = feedback_.factor();
  for (const auto& tree : tree_set_->trees()) {
    if (tree->level() < 0) continue;
    ++report_.per_level[static_cast<std::size_t>(tree->level())];
    if (isSeen(*tree, view)) report_.triangles += tree->triangleCount();
  }
  // Trees that change their level do not yet have its number of triangles.
  if (report_.waiting == 0 && report_.fading == 0 && report_.triangles > 0)
    feedback_.update(static_cast<double>(report_.triangles), options.target_triangles);
}

}  // namespace vegetation_sim::view
