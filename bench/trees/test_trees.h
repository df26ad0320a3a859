// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vegetation_sim/core/math/vectors.h"

namespace vegetation_sim::bench {

/// A round bar and the joint at its foot, from which every engine builds its tree.
struct TestLink {
  int parent{-1};         ///< index, lower than the own one; -1: the ground
  double h{0.0};          ///< position of the joint along the parent [m]
  Quat rest;              ///< in the parent's axes
  double length{0.0};     ///< [m]
  double radius{0.0};     ///< mean [m]
  double mass{0.0};       ///< [kg]
  double across{0.0};     ///< inertia about the joint, perpendicular to the bar [kg m^2]
  double along{0.0};      ///< inertia about the bar's axis [kg m^2]
  double stiffness{0.0};  ///< of both bends [N m/rad]
  double damping{0.0};    ///< of both bends [N m s/rad]
};

struct TestTree {
  std::string name;
  std::vector<TestLink> links;

  std::vector<int> tips() const;  ///< links without children
  std::uint64_t hash() const;
};

/// The fractal family: every branch splits in two, trunk radius 9 cm, tip radius 2 mm, length ~
/// radius^(2/3), longest path 8 m, E = 8 GPa, 900 kg/m^3, damping ratio 0.1.
TestTree fractalTree(int branches);

/// Returns the first `branches` joints, thick wood first, of a tree that the core grows from a
/// species file with as many limbs as it takes.
TestTree speciesTree(const std::string& file, int branches);

/// A force on each link at a fixed point of its axis, scaled by one factor of time.
struct TestLoad {
  enum class Kind : int { GUST = 0, PULL = 1 };
  Kind kind{Kind::GUST};
  std::vector<int> links;     ///< loaded links, rising
  std::vector<Vec3> force;    ///< [loaded] world axes, at factor 1 [N]
  std::vector<double> along;  ///< [loaded] from the joint [m]

  /// Returns the factor at `time` [s] in [0.05 interval, 0.05 (interval + 1)]; the interval selects
  /// the side of a discontinuity.
  double factor(int interval, double time) const;
  const char* name() const { return kind == Kind::GUST ? "gust" : "pull"; }
};

/// Returns a wind of 18 m/s sin^2(pi t) along x for a second, drag coefficient 1 on bare wood.
TestLoad gust(const TestTree& tree);
/// Returns 20 N along y for a second at the tip of the branch whose radius is nearest to 1 cm.
TestLoad pull(const TestTree& tree);

constexpr int INTERVALS = 60;         ///< instants at which tips are compared
constexpr double INTERVAL = 0.05;     ///< time between them [s]
constexpr int LOADED_INTERVALS = 20;  ///< intervals in which the load acts

}  // namespace vegetation_sim::bench
