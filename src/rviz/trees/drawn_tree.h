// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "forest/falling_piece.h"
#include "rviz/render/vertex_paint.h"
#include "tree/mesh/light_grid.h"
#include "tree/mesh/paint.h"
#include "tree/mesh/skin.h"
#include "vegetation_sim/forest/forest_replica.h"

namespace vegetation_sim::view {

/// `BY_STATE` colours bark as figure 4 of paper 1: joints that move red, in transition green, held
/// branches yellow; other physical ones blue.
enum class TreeColours : int { NATURAL = 0, BY_STATE = 1 };

/// Settings of the appearance of trees.
struct TreeLook {
  bool leaves{true};
  bool flutter{true};
  TreeColours colours{TreeColours::NATURAL};
};

/// One tree as it is drawn: its mesh at one level of detail, with vertex positions and colours. It
/// uses no Ogre.
class DrawnTree {
 public:
  /// Grows the tree. @param origin origin of all coordinates that it returns, layout's frame [m].
  DrawnTree(const forest::ForestReplica& replica, std::uint32_t id, const Vec3& origin);
  /// A piece that has come off tree `id`.
  DrawnTree(const forest::ForestReplica& replica, std::uint32_t id, const Vec3& origin,
            std::shared_ptr<const forest::FallingPiece> piece);

  /// Returns whether the tree has lost branches since it was grown.
  bool isOutdated(const forest::ForestReplica& replica) const {
    return !(broken_ == brokenOf(replica.broken(), id_));
  }
  /// Returns whether it is the piece of a record.
  bool isPiece(const forest::BrokenBranch& record) const {
    return piece_ && piece_->record() == record;
  }
  /// Grows the tree again; setLevels() has to follow.
  void regrow(const forest::ForestReplica& replica);

  std::uint32_t id() const { return id_; }
  const Vec3& origin() const { return origin_; }
  const Vec3& foot() const { return tree_.foot; }  ///< layout's frame [m]
  double height() const { return tree_.skeleton.height; }
  double reach() const { return tree_.skeleton.reach; }
  double leafSize() const { return species_.leaf_size; }  ///< edge of a cluster [m]
  int level() const { return levels_.trunk; }  ///< of geometry, or -1 before the first mesh
  const forest::TreeLevels& levels() const { return levels_; }
  /// Returns the levels for a viewer, see forest::treeLevels().
  forest::TreeLevels levelsFor(const Viewpoint& eye, double factor, bool by_bough) const;
  /// Counts the triangles of its level without those that fade out.
  std::size_t triangleCount() const { return shapes_.front().mesh.triangleCount(); }
  const forest::Tree& tree() const { return tree_; }

  /// Adds its leaves to a light grid in the layout's frame.
  void addTo(forest::LightGrid& light) const;
  /// Builds the mesh of levels of geometry at rest.
  /// @param fade_clock if positive, the previous mesh fades out from this time of the fade clock
  /// while
  ///   the new one fades in, until endFade().
  void setLevels(const forest::TreeLevels& levels, const forest::LightGrid& light,
                 const TreeLook& look, float fade_clock = 0.f);
  bool fading() const { return shapes_.size() > 1; }
  float fadesSince() const { return fades_since_; }
  void endFade();
  /// Moves the vertices to `stamp`. Returns false if nothing has changed since the last call.
  /// @param pixels_per_metre decides whether flutter is visible.
  bool move(const forest::ForestReplica& replica, Nanoseconds stamp, const wind::Instant& wind,
            const TreeLook& look, double pixels_per_metre);
  /// Colours the bark by the state of each joint at `stamp`. Returns false if nothing has changed.
  /// @param held branches that grabs hold, sorted.
  bool paintStates(const forest::ForestReplica& replica, Nanoseconds stamp, const TreeLook& look,
                   const std::vector<int>& held = {});

  struct Part {
    std::vector<float> positions;  ///< [3 per vertex], relative to the origin
    std::vector<VertexPaint> paint;
  };
  struct Shape {
    int depths{0};  ///< recursion depths whose poses it needs
    forest::TreeMesh mesh;
    Part bark, leaves;
  };
  /// Meshes that are drawn: that of its level, then the one that fades out, if any.
  const std::vector<Shape>& shapes() const { return shapes_; }

 private:
  bool movePiece(Nanoseconds stamp);
  Shape makeShape(const forest::TreeLevels& levels, const TreeLook& look) const;
  int depths() const;
  void poseAtRest();
  void skin(const forest::Flutter& flutter);
  void paintBark(const forest::LightGrid& light, Shape& shape);
  void paintLeaves(const forest::LightGrid& light, Shape& shape);
  Vec3 inLayout(const float* position) const;

  std::uint32_t id_;
  Vec3 origin_;
  forest::BrokenBranches broken_;
  std::shared_ptr<const forest::FallingPiece> piece_;  // null: a tree
  forest::Tree tree_;
  forest::Species species_;
  forest::TreePaint paint_;
  forest::BatchPoser poser_;
  forest::Boughs boughs_;
  forest::TreeLevels levels_;
  forest::BatchPoses poses_;
  std::vector<Shape> shapes_ = std::vector<Shape>(1);
  float fades_since_{0.f};
  bool moved_{true};  // the last move() left it away from rest
  forest::Weights painted_{};
  std::vector<int> painted_physical_, painted_held_;  // branches
  bool painted_by_state_{false};
};

}  // namespace vegetation_sim::view
