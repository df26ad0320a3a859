// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tree/mesh/bark_mesh.h"
#include "vegetation_sim/tree/motion/batch_poser.h"

namespace vegetation_sim::forest {

/// Triangles of a card by corner.
constexpr std::array<std::uint32_t, 6> LEAF_TRIANGLES{0, 1, 2, 0, 2, 3};

/// Rotations of leaf cards at one stamp and wind speed, for 64 kinds of cards, so that many cards
/// are cheap.
class Flutter {
 public:
  static constexpr int KINDS = 64;
  /// Creates a flutter of zero.
  Flutter() = default;
  /// @param seconds, wind_speed, largest as in leafFlutter().
  Flutter(double seconds, double wind_speed, double largest);

  /// About the midrib and about the foot [rad].
  const std::array<float, 2>& of(std::uint32_t key) const { return turns_[key >> 26]; }

 private:
  std::array<std::array<float, 2>, KINDS> turns_{};
};

/// Writes the positions of the bark's vertices: [3 per vertex, mesh.bark.size()] x y z [m], in the
/// tree's frame moved by `foot`. `poses` holds at least the branches of the mesh.
void skinBark(const TreeMesh& mesh, const BatchPoses& poses, const std::array<float, 3>& foot,
              float* positions);
/// Writes the unit normals of the bark: [3 per vertex].
void turnBarkNormals(const TreeMesh& mesh, const BatchPoses& poses, float* normals);

/// Writes the corners of the leaf cards: [4 corners x 3 per card].
void skinLeaves(const TreeMesh& mesh, const BatchPoses& poses, const std::array<float, 3>& foot,
                const Flutter& flutter, float* positions);

}  // namespace vegetation_sim::forest
