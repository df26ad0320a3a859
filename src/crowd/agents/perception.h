// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "crowd/body/walker.h"
#include "crowd/geometry/obstacle_grid.h"

namespace vegetation_sim::crowd {

enum class Seen : int { STATIC, WALKER, ROBOT };

/// One of the nearest obstacles. Members have no initial values, since most of a view stays unused.
struct Sight {
  Seen kind;
  std::uint32_t index;       ///< index of the static obstacle, walker or robot
  double gap;                ///< distance of the outlines, below 0 if they overlap [m]
  double lower;              ///< guaranteed lower bound of the gap, up to rounding [m]
  Point normal;              ///< unit vector towards it; zero if the walker's centre is inside
  Point velocity;            ///< [m/s]
  const Obstacle* obstacle;  ///< null for a disc
  Point place;               ///< centre of a disc [m]
  double radius;             ///< radius of a disc [m]
};

/// Perception of a walker: (d, theta) of paper 2, section 5.1 (S2-31), of the nearest obstacles.
struct View {
  static constexpr int MOST = 8;
  std::array<Sight, MOST> sights;  ///< sights, nearest first
  int count{0};
  double beyond{0.0};  ///< lower bound of the distance of all other obstacles [m]

  const Sight& at(int i) const { return sights[static_cast<std::size_t>(i)]; }
};

/// People by position, in buckets of a periodic grid, so that the memory depends only on their
/// number.
class WalkerGrid {
 public:
  struct Spot {
    Point position, velocity;
    double radius;
    std::uint32_t index;
  };
  void build(const std::vector<Walker>& walkers, double cell);
  /// Returns all people, neighbours near each other.
  const std::vector<Spot>& spots() const { return spots_; }
  template <class Visit>
  void visitNear(const Point& place, Visit visit) const;

 private:
  std::uint32_t bucketOf(std::int64_t column, std::int64_t row) const {
    return (static_cast<std::uint32_t>(row) & mask_) << bits_ |
           (static_cast<std::uint32_t>(column) & mask_);
  }
  std::int64_t cellOf(double x) const {
    const double cells = x * per_metre_;
    const auto whole = static_cast<std::int64_t>(cells);
    return whole - (cells < static_cast<double>(whole));
  }

  double per_metre_{1.0};
  std::uint32_t bits_{2}, mask_{3};
  std::vector<std::uint32_t> starts_, buckets_;
  std::vector<Spot> spots_;
};

/// All possible obstacles at one tick.
struct Surroundings {
  const ObstacleGrid* still{nullptr};
  const WalkerGrid* walkers{nullptr};
  const std::vector<Obstacle>* robots{nullptr};
};

/// Returns the `most` nearest obstacles within the sensor's range. Candidates of the grids are
/// measured in the order of their circles' distances until the next cannot be nearer; the result
/// equals that of measuring all. @param self index of the walker.
View perceive(const Walker& walker, std::uint32_t self, const Surroundings& around,
              double sensor_range, int most);
/// Returns the same by measuring all obstacles; for tests and benches.
View perceiveAll(const Walker& walker, std::uint32_t self, const std::vector<Walker>& walkers,
                 const Surroundings& around, double sensor_range, int most);

}  // namespace vegetation_sim::crowd
