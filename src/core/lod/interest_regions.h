// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace vegetation_sim {

/// A disc of the ground, in the world frame.
struct InterestArea {
  double x{0.0}, y{0.0}, radius{0.0};  ///< [m]
};
bool operator==(const InterestArea& a, const InterestArea& b);
/// Returns whether all of `inner` lies in one of `discs`.
bool covers(const std::vector<InterestArea>& discs, const InterestArea& inner);

/// The discs of the ground of which listeners get details. They exceed what is wanted by a margin
/// and stay where they are until a listener leaves it, so that they change seldom.
class InterestRegions {
 public:
  static constexpr double MARGIN = 20.0;  ///< [m]

  /// Keeps the discs that cover a wanted one, drops the others, and adds what is missing.
  /// @return whether a disc has been added, or the last one has been dropped.
  bool update(const std::vector<InterestArea>& wanted);
  /// Returns whether a square touches a disc. Without discs, all squares do, since no listener
  /// is known. @param side of the square, with its lower corner at x, y [m]; 0: a point.
  bool includes(double x, double y, double side = 0.0) const;
  const std::vector<InterestArea>& discs() const { return discs_; }

 private:
  std::vector<InterestArea> discs_;
};

}  // namespace vegetation_sim
