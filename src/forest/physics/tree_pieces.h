// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "forest/physics/forest_physics.h"

namespace vegetation_sim::forest {

/// What comes off one tree in a tick. Each branch goes with the first piece that carries it.
class TreePieces {
 public:
  TreePieces(const Skeleton& skeleton, const Wood& wood)
      : skeleton_(skeleton), wood_(wood), piece_of_(skeleton.branches.size(), -1) {}

  bool isGone(int branch) const { return isOf(branch) || skeleton_.branches[index(branch)].broken; }
  /// Returns whether a branch goes with one of the pieces.
  bool isOf(int branch) const { return piece_of_[index(branch)] >= 0; }
  Break& pieceOf(int branch) { return list_[index(piece_of_[index(branch)])]; }
  /// Adds a piece and sets its mass.
  void add(Break piece) {
    const int root = piece.piece.branch, number = static_cast<int>(list_.size());
    mark(root, number);
    piece.mass = ownMass(root);
    for (const Break& earlier : list_) {
      const int parent = skeleton_.branches[index(earlier.piece.branch)].parent;
      if (parent >= 0 && piece_of_[index(parent)] == number)
        piece.mass -= ownMass(earlier.piece.branch);
    }
    list_.push_back(std::move(piece));
  }
  const std::vector<Break>& list() const { return list_; }

 private:
  // Mass of a sub-tree without the fluid that moves with it.
  double ownMass(int branch) const {
    return wood_.subtree[index(branch)].mass / (1.0 + wood_.added_mass);
  }
  void mark(int root, int number) {
    const std::vector<Branch>& branches = skeleton_.branches;
    piece_of_[index(root)] = number;
    for (std::size_t i = index(root) + 1; i < branches.size(); ++i)
      if (piece_of_[i] < 0 && !branches[i].broken && branches[i].parent >= root &&
          piece_of_[index(branches[i].parent)] == number)
        piece_of_[i] = number;
  }

  const Skeleton& skeleton_;
  const Wood& wood_;
  std::vector<int> piece_of_;  // of each branch; -1: of none
  std::vector<Break> list_;
};

}  // namespace vegetation_sim::forest
