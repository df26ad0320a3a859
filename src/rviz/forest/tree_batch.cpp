// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz/forest/tree_batch.h"

#include <algorithm>

#include "rviz/render/material.h"
#include "rviz/render/texture.h"

namespace vegetation_sim::view {
namespace {

constexpr float MARGIN = 0.25f;  // tips move by this part of the height of a tree

using Part = DrawnTree::Part DrawnTree::Shape::*;

// Concatenates an attribute of the vertices of a part, tree by tree and shape by shape.
template <class T>
std::vector<T> gathered(const std::vector<DrawnTree*>& trees, Part part,
                        std::vector<T> DrawnTree::Part::*what) {
  std::size_t size = 0;
  for (const DrawnTree* tree : trees)
    for (const DrawnTree::Shape& shape : tree->shapes()) size += (shape.*part.*what).size();
  std::vector<T> out;
  out.reserve(size);
  for (const DrawnTree* tree : trees) {
    for (const DrawnTree::Shape& shape : tree->shapes()) {
      const std::vector<T>& some = shape.*part.*what;
      out.insert(out.end(), some.begin(), some.end());
    }
  }
  return out;
}

std::vector<float> positionsOf(const std::vector<DrawnTree*>& trees, Part part) {
  return gathered(trees, part, &DrawnTree::Part::positions);
}

std::vector<VertexPaint> paintOf(const std::vector<DrawnTree*>& trees, Part part) {
  return gathered(trees, part, &DrawnTree::Part::paint);
}

std::vector<std::uint32_t> barkTriangles(const std::vector<DrawnTree*>& trees) {
  std::vector<std::uint32_t> out;
  std::uint32_t first = 0;
  for (const DrawnTree* tree : trees) {
    for (const DrawnTree::Shape& shape : tree->shapes()) {
      for (const std::uint32_t index : shape.mesh.triangles) out.push_back(first + index);
      first += static_cast<std::uint32_t>(shape.bark.paint.size());
    }
  }
  return out;
}

// Returns the triangles of all leaf cards, sorted front to back for a viewer.
std::vector<std::uint32_t> leafTriangles(const std::vector<DrawnTree*>& trees, const Vec3& eye) {
  if (trees.empty()) return {};
  const Vec3 from = eye - trees.front()->origin();
  const std::vector<float> at = positionsOf(trees, &DrawnTree::Shape::leaves);
  std::vector<std::pair<float, std::uint32_t>> cards;
  for (std::size_t i = 0; i + 11 < at.size(); i += 12) {
    const Vec3 corner(at[i], at[i + 1], at[i + 2]);
    cards.emplace_back(static_cast<float>((corner - from).squaredNorm()),
                       static_cast<std::uint32_t>(cards.size()));
  }
  std::sort(cards.begin(), cards.end());
  std::vector<std::uint32_t> out;
  out.reserve(6 * cards.size());
  for (const auto& card : cards)
    for (const std::uint32_t corner : forest::LEAF_TRIANGLES)
      out.push_back(forest::LEAF_CORNERS * card.second + corner);
  return out;
}

}  // namespace

TreeBatch::TreeBatch(std::vector<DrawnTree*> trees, Ogre::SceneNode& node,
                     const TreeMaterials& materials)
    : trees_(std::move(trees)),
      materials_(materials),
      bark_(uniqueName("bark"), materials.bark),
      leaves_(uniqueName("leaves"), materials.leaves) {
  for (const DrawnTree* tree : trees_) middle_ += tree->foot();
  middle_ /= static_cast<double>(std::max<std::size_t>(trees_.size(), 1));
  node.attachObject(&bark_);
  node.attachObject(&leaves_);
}

void TreeBatch::rebuild() {
  double tallest = 0.0;
  for (const DrawnTree* tree : trees_) tallest = std::max(tallest, tree->height());
  const float margin = MARGIN * static_cast<float>(tallest);
  bark_.build(positionsOf(trees_, &DrawnTree::Shape::bark),
              paintOf(trees_, &DrawnTree::Shape::bark), barkTriangles(trees_), margin);
  leaves_.build(positionsOf(trees_, &DrawnTree::Shape::leaves),
                paintOf(trees_, &DrawnTree::Shape::leaves),
                leafTriangles(trees_, middle_ + 1000.0 * sorted_for_), margin);
  built_ = true;
  fading_ = std::any_of(trees_.begin(), trees_.end(),
                        [](const DrawnTree* tree) { return tree->fading(); });
  wear();
}

void TreeBatch::wear() {
  bark_.wear(fading_ ? materials_.fading_bark : materials_.bark);
  leaves_.wear(fading_ ? materials_.fading_leaves
               : near_ ? materials_.near_leaves
                       : materials_.leaves);
}

void TreeBatch::setEye(const Vec3& eye) {
  const bool near = std::any_of(trees_.begin(), trees_.end(), [&](const DrawnTree* tree) {
    const Vec3 middle = tree->foot() + Vec3(0.0, 0.0, 0.5 * tree->height());
    return length(eye - middle) < Material::NEAR_END + tree->reach() + 0.5 * tree->height();
  });
  if (near == near_) return;
  near_ = near;
  if (built_) wear();
}

void TreeBatch::takePositions() {
  if (!built_) return;
  bark_.move(positionsOf(trees_, &DrawnTree::Shape::bark));
  leaves_.move(positionsOf(trees_, &DrawnTree::Shape::leaves));
}

void TreeBatch::takePaint() {
  if (built_) bark_.paint(paintOf(trees_, &DrawnTree::Shape::bark));
}

bool TreeBatch::takeSeen() {
  const bool bark = bark_.takeSeen(), leaves = leaves_.takeSeen();
  return bark || leaves;
}

bool TreeBatch::sortFor(const Vec3& eye) {
  constexpr double SAME = 0.97;  // cosine of about 14 degrees
  const Vec3 direction = (eye - middle_) / std::max(length(eye - middle_), 1e-6);
  if (!built_ || dot(direction, sorted_for_) > SAME) return false;
  sorted_for_ = direction;
  leaves_.reorder(leafTriangles(trees_, eye));
  return true;
}

void TreeBatch::setRank(int rank) {
  bark_.setRank(rank);
  leaves_.setRank(rank);
}

std::vector<std::vector<DrawnTree*>> splitByPlace(std::vector<DrawnTree*> trees, std::size_t most) {
  if (trees.size() <= most) return {std::move(trees)};
  Vec3 low = trees.front()->foot(), high = low;
  for (const DrawnTree* tree : trees) {
    low = low.cwiseMin(tree->foot());
    high = high.cwiseMax(tree->foot());
  }
  const int side = high.x() - low.x() > high.y() - low.y() ? 0 : 1;
  const auto half = trees.begin() + static_cast<std::ptrdiff_t>(trees.size() / 2);
  std::nth_element(trees.begin(), half, trees.end(),
                   [side](const DrawnTree* a, const DrawnTree* b) {
                     return a->foot()[side] != b->foot()[side] ? a->foot()[side] < b->foot()[side]
                                                               : a->id() < b->id();
                   });
  auto out = splitByPlace({trees.begin(), half}, most);
  auto rest = splitByPlace({half, trees.end()}, most);
  std::move(rest.begin(), rest.end(), std::back_inserter(out));
  return out;
}

}  // namespace vegetation_sim::view
