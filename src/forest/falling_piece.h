// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "vegetation_sim/tree/motion/pose.h"

namespace vegetation_sim::forest {

/// A piece that has come off a tree, as displays and sensors show it: rigid and falling freely,
/// with the velocity and the angular velocity that its joint had, until a tip meets the ground;
/// then it turns about its centre of mass until that lies level with its joint, and rests. In a
/// fluid denser than air, which is taken to be at rest, it has buoyancy, added mass and linear
/// drag, and rises if it is lighter. A function of its record and the stamp alone, so that all
/// replicas and late joiners have the same bits. It touches nothing but the ground, and rests where
/// it is after 10 s of fall.
class FallingPiece {
 public:
  /// @param number of the piece in `broken`, which has all that has come off the tree.
  /// @throws InvalidInput for broken branches that the tree does not have.
  FallingPiece(const Layout& layout, const terrain::HeightMap& terrain, std::uint32_t tree,
               const BrokenBranches& broken, std::size_t number);

  /// The branches of the piece alone, the broken one first. The seed and the foot are those of its
  /// tree; it answers no wind.
  const Tree& tree() const { return tree_; }
  /// Index in its tree of each branch of tree(), rising.
  const std::vector<int>& branches() const { return branches_; }
  /// Returns the work that it took to grow the piece and to find where it lands, as the number of
  /// branches of a tree whose growth takes as long.
  std::size_t work() const { return work_; }
  const BrokenBranch& record() const { return record_; }
  /// Stamps at which it meets the ground, and from which on it rests.
  Nanoseconds landsAt() const { return record_.stamp + fromSeconds(fall_time_); }
  Nanoseconds restsFrom() const;
  /// Returns the pose of every branch of tree() at a stamp, in the tree's frame. Before it came
  /// off, it is where it did.
  std::vector<Pose> poseAt(Nanoseconds stamp) const;
  /// Returns where its joint is at a stamp, world, and the distance from it to the farthest tip
  /// [m].
  Vec3 placeAt(Nanoseconds stamp) const;
  double reach() const { return reach_; }
  /// Returns whether the piece of a record may come into a ball at any time. @param size bound of
  /// its tree's [m].
  static bool mayReach(const BrokenBranch& record, double size, const Vec3& centre, double radius);

 private:
  Pose fallenAt(double time) const;
  Pose turnedBy(double share) const;
  Pose jointAt(double time) const;
  double clearance(const terrain::HeightMap& terrain, const Pose& joint) const;
  void land(const terrain::HeightMap& terrain);

  BrokenBranch record_;
  Tree tree_;
  std::vector<int> branches_;
  std::size_t work_{0};
  std::vector<Vec3> points_;       // ends of its wood, in the frame of its joint [m]
  Vec3 centre_{Vec3::Zero()};      // of mass, in the frame of its joint [m]
  double gravity_{0.0};            // acceleration downwards without drag, below 0: it rises [m/s^2]
  double drag_{0.0};               // per mass [1/s]
  Vec3 velocity_{Vec3::Zero()};    // of the centre of mass as it comes off, world [m/s]
  double reach_{0.0};              // [m]
  double fall_time_{0.0};          // [s]
  Pose landed_;                    // joint, world
  Vec3 turn_axis_{Vec3::UnitX()};  // of the turn on the ground, world, unit
  double turn_angle_{0.0};         // [rad]
  std::vector<double> heights_;    // of the centre of mass by share of the turn, world [m]
};

/// A piece of a forest that has come off, by tree and its number there.
struct PieceKey {
  std::uint32_t tree{0};
  std::size_t number{0};
};
/// Returns all pieces in the order in which they came off, of equal stamps in that of the trees:
/// the place of a piece in it does not change.
std::vector<PieceKey> piecesOf(const BrokenTrees& trees);

}  // namespace vegetation_sim::forest
